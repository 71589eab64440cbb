// Names of places over the heat map: the largest that fit without touching each other.
import L from './leaflet.js';
import { element } from './dom.js';

const LARGE = 400; // of the list, which begins with the largest, so many are written larger
const most = (zoom) => 2.2 ** (zoom + 3.2); // how far down the list a zoom looks

export const Places = L.Layer.extend({
  initialize(rows, options) {
    L.setOptions(this, options);
    this.places = rows.map(([name, x, y], rank) => ({ name, rank, at: L.latLng(y / 1000, x / 1000) }));
  },

  onAdd(map) {
    this.box = element('div.places.leaflet-zoom-hide', { 'aria-hidden': 'true' });
    map.getPane('places').append(this.box);
    map.on('moveend zoomend resize', this.draw, this);
    this.draw();
  },

  onRemove(map) {
    map.off('moveend zoomend resize', this.draw, this);
    this.box.remove();
  },

  draw() {
    const zoom = this._map.getZoom();
    const bounds = this._map.getBounds();
    const middle = bounds.getCenter().lng;
    const taken = [];
    const labels = [];
    if (zoom < 3) return this.box.replaceChildren();
    for (const place of this.places.slice(0, most(zoom))) {
      const turn = 360 * Math.round((middle - place.at.lng) / 360);
      const at = L.latLng(place.at.lat, place.at.lng + turn);
      if (!bounds.contains(at)) continue;
      const { x, y } = this._map.latLngToLayerPoint(at);
      const large = place.rank < LARGE;
      const box = L.bounds([x - 6, y - 11], [x + 14 + place.name.length * (large ? 8 : 6.5), y + 11]);
      if (taken.some((other) => other.intersects(box))) continue;
      taken.push(box);
      labels.push(this.label(place.name, large, x, y));
    }
    this.box.replaceChildren(...labels);
  },

  label(name, large, x, y) {
    const label = element(large ? 'span.place-name.large' : 'span.place-name', {}, name);
    label.style.left = `${x}px`;
    label.style.top = `${y}px`;
    return label;
  },
});
