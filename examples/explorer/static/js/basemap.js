// The map below: land and borders from one file, drawn into tiles by the page itself, so that it follows the theme at every zoom.
import L from './leaflet.js';
import { colour } from './dom.js';

// A line of the file: longitude and latitude in 0.01 degrees, then differences; here with its bounds.
function decode(numbers) {
  const points = [];
  const bounds = L.latLngBounds([]);
  for (let i = 0, x = 0, y = 0; i < numbers.length; i += 2) {
    x += numbers[i];
    y += numbers[i + 1];
    points.push(L.latLng(y / 100, x / 100));
    bounds.extend(points.at(-1));
  }
  return { points, bounds };
}

const MARGIN = 8; // pixels around a tile that its lines are drawn in, so that strokes do not end at its edge

export const Basemap = L.GridLayer.extend({
  initialize(data, options) {
    L.setOptions(this, options);
    this.land = data.land.map(decode);
    this.borders = data.borders.map(decode);
  },

  createTile(coords) {
    const { x: width, y: height } = this.getTileSize();
    const ratio = devicePixelRatio || 1;
    const canvas = Object.assign(document.createElement('canvas'), { width: width * ratio, height: height * ratio });
    const pen = canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.lineJoin = 'round';
    this.drawTile(pen, coords, L.bounds([0, 0], [width, height]));
    return canvas;
  },

  drawTile(pen, coords, tile) {
    const box = L.bounds(tile.min.subtract([MARGIN, MARGIN]), tile.max.add([MARGIN, MARGIN]));
    const origin = coords.scaleBy(this.getTileSize());
    const project = (points) => points.map((point) => this._map.project(point, coords.z)._subtract(origin));
    const around = this._tileCoordsToBounds(coords).pad(0.1);
    const seen = (lines) => lines.filter(({ bounds }) => bounds.intersects(around));
    const land = seen(this.land).map(({ points }) => project(points));

    pen.beginPath();
    for (const ring of land) this.tracePath(pen, L.PolyUtil.clipPolygon(ring, box));
    pen.fillStyle = colour('--land');
    pen.fill('evenodd');

    this.strokeLines(pen, seen(this.borders).map(({ points }) => project(points)), box, '--border');
    this.strokeLines(pen, land, box, '--coast', L.CRS.EPSG3857.scale(coords.z), origin);
  },

  tracePath(pen, points) {
    points.forEach(({ x, y }, i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.closePath();
  },

  // Segments along the antimeridian, where rings are cut, and along the pole are no coast.
  strokeLines(pen, lines, box, name, world, origin) {
    const cut = ({ x }) => world && (Math.abs(x + origin.x) < 1e-3 || Math.abs(x + origin.x - world) < 1e-3);
    pen.beginPath();
    for (const line of lines) {
      for (let i = 1; i < line.length; ++i) {
        const part = cut(line[i - 1]) && cut(line[i]) ? false : L.LineUtil.clipSegment(line[i - 1], line[i], box, false);
        if (!part) continue;
        pen.moveTo(part[0].x, part[0].y);
        pen.lineTo(part[1].x, part[1].y);
      }
    }
    pen.strokeStyle = colour(name);
    pen.lineWidth = 1;
    pen.stroke();
  },
});
