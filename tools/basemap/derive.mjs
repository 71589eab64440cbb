// Derive examples/explorer/static/basemap.json and examples/explorer/static/vendor from npm packages and examples/data/places.tsv:
//     npm ci --prefix tools/basemap
//     node tools/basemap/derive.mjs examples/explorer/static
import { cpSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import { feature, mesh } from 'topojson-client';
import { cutLine, cutRing } from './cut.mjs';

const PLACES = 12000;
const folder = process.argv[2];
const require = createRequire(import.meta.url);

// A line as integers of 0.01 degrees: the first longitude and latitude, then the differences to the point before.
function encode(points) {
  const grid = points.map((point) => point.map((degrees) => Math.round(100 * degrees)))
    .filter(([x, y], i, all) => i === 0 || x !== all[i - 1][0] || y !== all[i - 1][1]);
  return grid.flatMap(([x, y], i) => (i ? [x - grid[i - 1][0], y - grid[i - 1][1]] : [x, y]));
}

const polygons = ({ type, coordinates }) => (type === 'Polygon' ? [coordinates] : coordinates);

function land(atlas) {
  const rings = feature(atlas, atlas.objects.land).features.flatMap(({ geometry }) => polygons(geometry).flat());
  return rings.flatMap(cutRing).map(encode).filter((ring) => ring.length >= 8);
}

function borders(atlas) {
  const lines = mesh(atlas, atlas.objects.countries, (a, b) => a !== b).coordinates;
  return lines.flatMap(cutLine).map(encode).filter((line) => line.length >= 4);
}

// The largest places, largest first: name, and longitude and latitude in 0.001 degrees.
function places() {
  const file = fileURLToPath(new URL('../../examples/data/places.tsv', import.meta.url));
  const rows = readFileSync(file, 'utf8').split('\n').filter((row) => row && !row.startsWith('#')).slice(0, PLACES);
  return rows.map((row) => row.split('\t'))
    .map(([lat, lon, , , name]) => [name, Math.round(1000 * lon), Math.round(1000 * lat)]);
}

function basemap() {
  const atlas = require('world-atlas/countries-50m.json');
  const about = 'Land and borders: Natural Earth 1:50m (public domain) through npm world-atlas 2.0.2 (ISC), rings cut at the antimeridian; '
    + 'lists of integers, 0.01 degrees: longitude and latitude of the first point, then differences to the point before. '
    + 'Places: GeoNames (CC BY 4.0), name, longitude and latitude in 0.001 degrees, largest first. By tools/basemap/derive.mjs.';
  const rows = (list) => `[\n${list.map((item) => JSON.stringify(item)).join(',\n')}\n]`;
  const parts = { land: rows(land(atlas)), borders: rows(borders(atlas)), places: rows(places()) };
  const body = Object.entries(parts).map(([name, text]) => `"${name}": ${text}`).join(',\n');
  writeFileSync(`${folder}/basemap.json`, `{"about": ${JSON.stringify(about)},\n${body}}\n`);
}

// Leaflet as it comes: script, style sheet, licence. Its pictures are of markers and a control that the page does not use.
function leaflet() {
  const from = fileURLToPath(new URL('node_modules/leaflet/', import.meta.url));
  mkdirSync(`${folder}/vendor/leaflet`, { recursive: true });
  for (const file of ['dist/leaflet.js', 'dist/leaflet.css', 'LICENSE']) {
    cpSync(from + file, `${folder}/vendor/leaflet/${file.split('/').pop()}`);
  }
}

basemap();
leaflet();
