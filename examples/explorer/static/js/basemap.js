// The map below: land and borders from one file, drawn into tiles by the page itself, so that it follows the theme at every zoom.
import L from './leaflet.js';
import { colour } from './dom.js';

const MOST = 85.0511287798066; // Web Mercator's latitudes

// A line of the file: longitude and latitude in 0.01 degrees, then differences; here on the map, 0..1 from the north-west, with its bounds.
function decode(numbers) {
  const count = numbers.length / 2;
  const line = { xs: new Float64Array(count), ys: new Float64Array(count), left: Infinity, right: -Infinity, top: Infinity, bottom: -Infinity };
  for (let i = 0, longitude = 0, latitude = 0; i < count; ++i) {
    longitude += numbers[2 * i];
    latitude += numbers[2 * i + 1];
    const sine = Math.sin(Math.max(-MOST, Math.min(MOST, latitude / 100)) * Math.PI / 180);
    const x = line.xs[i] = longitude / 36000 + 0.5;
    const y = line.ys[i] = 0.5 - Math.log((1 + sine) / (1 - sine)) / (4 * Math.PI);
    line.left = Math.min(line.left, x);
    line.right = Math.max(line.right, x);
    line.top = Math.min(line.top, y);
    line.bottom = Math.max(line.bottom, y);
  }
  return line;
}

const LEAST = 1; // pixel between two points of a line; closer ones are left out, but for those where rings are cut

// A line's pixels, from `origin` on, on a map `world` pixels wide.
function pixels({ xs, ys }, world, origin) {
  const points = [];
  for (let i = 0, x, y; i < xs.length; ++i) {
    const nextX = xs[i] * world - origin.x, nextY = ys[i] * world - origin.y;
    const edge = xs[i] === 0 || xs[i] === 1 || i === 0 || i === xs.length - 1;
    if (!edge && Math.abs(nextX - x) < LEAST && Math.abs(nextY - y) < LEAST) continue;
    points.push(L.point(x = nextX, y = nextY));
  }
  return points;
}

const MARGIN = 8; // pixels around a tile that its lines are drawn in, so that strokes do not end at its edge

export const Basemap = L.GridLayer.extend({
  initialize(data, options) {
    L.setOptions(this, options);
    this.land = data.land.map(decode);
    this.borders = data.borders.map(decode);
    this.inks = null; // colours of the theme, asked for once: each question makes the browser compute the page's style
  },

  redraw() {
    this.inks = null;
    return L.GridLayer.prototype.redraw.call(this);
  },

  // Each tile is drawn in a task of its own: the page answers between them.
  createTile(coords, done) {
    const { x: width, y: height } = this.getTileSize();
    const ratio = devicePixelRatio || 1;
    const canvas = Object.assign(document.createElement('canvas'), { width: width * ratio, height: height * ratio });
    const pen = canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.lineJoin = 'round';
    setTimeout(() => {
      this.drawTile(pen, coords, L.bounds([0, 0], [width, height]));
      done(null, canvas);
    });
    return canvas;
  },

  drawTile(pen, coords, tile) {
    this.inks ??= { land: colour('--land'), border: colour('--border'), coast: colour('--coast') };
    const box = L.bounds(tile.min.subtract([MARGIN, MARGIN]), tile.max.add([MARGIN, MARGIN]));
    const origin = coords.scaleBy(this.getTileSize());
    const world = L.CRS.EPSG3857.scale(coords.z);
    const crosses = ({ left, right, top, bottom }) => left * world <= origin.x + box.max.x && right * world >= origin.x + box.min.x &&
      top * world <= origin.y + box.max.y && bottom * world >= origin.y + box.min.y;
    const seen = (lines) => lines.filter(crosses).map((line) => pixels(line, world, origin));
    const land = seen(this.land);

    pen.beginPath();
    for (const ring of land) this.tracePath(pen, L.PolyUtil.clipPolygon(ring, box));
    pen.fillStyle = this.inks.land;
    pen.fill('evenodd');

    this.strokeLines(pen, seen(this.borders), box, this.inks.border);
    this.strokeLines(pen, land, box, this.inks.coast, world, origin);
  },

  tracePath(pen, points) {
    points.forEach(({ x, y }, i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.closePath();
  },

  // Segments along the antimeridian, where rings are cut, and along the pole are no coast.
  strokeLines(pen, lines, box, ink, world, origin) {
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
    pen.strokeStyle = ink;
    pen.lineWidth = 1;
    pen.stroke();
  },
});
