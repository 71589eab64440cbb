// Records as dots on the map.
import L from './leaflet.js';

export class Dots {
  constructor(map, opened) {
    this.map = map;
    this.opened = opened;
    this.layer = L.layerGroup().addTo(map);
    this.dots = new Map();
  }

  show(records) {
    this.layer.clearLayers();
    this.dots.clear();
    for (const record of records) {
      const turn = 360 * Math.round((this.map.getCenter().lng - record.lon) / 360);
      const dot = L.circleMarker([record.lat, record.lon + turn], { radius: 4, className: 'dot-record', bubblingMouseEvents: false });
      dot.on('click', () => this.opened(record));
      this.dots.set(record, dot.addTo(this.layer));
    }
  }

  // Mark one record, or none.
  choose(record) {
    this.chosen?.setRadius(4)._path?.classList.remove('chosen');
    this.chosen = this.dots.get(record);
    this.chosen?.setRadius(7).bringToFront()._path?.classList.add('chosen');
  }
}
