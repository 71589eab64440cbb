// The heat map as a tile layer that is drawn anew in place: new pictures are fetched while the old ones are shown, and all of them
// change in one frame, so that nothing flickers.
import L from './leaflet.js';
import { fetched } from './api.js';

export const HeatLayer = L.GridLayer.extend({
  options: { className: 'heat' },

  // `parameters(zoom)` tells what tiles are asked with; `failed(error)` hears of those that did not come.
  initialize(parameters, failed, options) {
    L.setOptions(this, options);
    this.parameters = parameters;
    this.failed = failed;
    this.shown = Infinity; // the oldest version that a tile shows
    this.on('tileunload', ({ tile }) => tile.request?.abort());
  },

  createTile(coords, done) {
    const { x: width, y: height } = this.getTileSize();
    const tile = Object.assign(document.createElement('canvas'), { width, height, className: 'heat-tile' });
    tile.first = done;
    this.load(tile, coords).then((picture) => this.paint(tile, picture), (error) => this.miss(tile, error));
    return tile;
  },

  // A tile's first picture, or that there is none, is told to Leaflet, whichever request brings it.
  settle(tile, error) {
    tile.first?.(error, tile);
    tile.first = null;
  },

  // A request that was overtaken or whose tile has left is no failure.
  miss(tile, error) {
    if (error.name === 'AbortError') return;
    this.failed(error);
    this.settle(tile, error);
  },

  async load(tile, { x, y, z }) {
    tile.request?.abort();
    const request = tile.request = new AbortController();
    const answer = await fetched(`/tiles/${z}/${x}/${y}.png`, this.parameters(z), request.signal);
    this.shown = Math.min(this.shown, Number(answer.headers.get('Locus-Version')));
    return createImageBitmap(await answer.blob());
  },

  paint(tile, picture) {
    const pen = tile.getContext('2d');
    pen.globalCompositeOperation = 'copy';
    pen.drawImage(picture, 0, 0, tile.width, tile.height);
    picture.close();
    this.settle(tile, null);
  },

  // Draw all tiles anew; answers when they have changed. Asked while it is at it, it begins again with what is to be shown by then.
  async refresh() {
    if (this.refreshing) {
      this.overtaken = true;
      return;
    }
    this.refreshing = true;
    try {
      do {
        this.overtaken = false;
        await this.drawAgain();
      } while (this.overtaken);
    } finally {
      this.refreshing = false;
    }
  },

  async drawAgain() {
    const tiles = Object.values(this._tiles ?? {}).filter(({ current }) => current);
    this.shown = Infinity;
    const pictures = await Promise.allSettled(tiles.map(({ el, coords }) => this.load(el, this._wrapCoords(coords))));
    pictures.forEach(({ status, value, reason }, i) => {
      if (status === 'fulfilled') this.paint(tiles[i].el, value);
      else this.miss(tiles[i].el, reason);
    });
  },
});
