// Draw a rectangle on the map: shift-drag, or any drag after arm() (fingers have no shift key). Calls `done(box)`.
import L from './leaflet.js';
import { element } from './dom.js';

const LEAST_PIXELS = 4;
const wrap = (longitude) => (longitude >= -180 && longitude <= 180 ? longitude : ((longitude + 180) % 360 + 360) % 360 - 180);

// A box in degrees as the server takes it: west > east crosses the antimeridian.
export function boxOf(bounds) {
  const [south, north] = [bounds.getSouth(), bounds.getNorth()].map((degrees) => Math.max(-90, Math.min(90, degrees)));
  if (bounds.getEast() - bounds.getWest() >= 360) return { south, west: -180, north, east: 180 };
  return { south, west: wrap(bounds.getWest()), north, east: wrap(bounds.getEast()) };
}

// The box on the copy of the world that is in view.
export function boundsOf({ south, west, north, east }, map) {
  const right = east < west ? east + 360 : east;
  const turn = 360 * Math.round((map.getCenter().lng - (west + right) / 2) / 360);
  return L.latLngBounds([south, west + turn], [north, right + turn]);
}

export class Rubber {
  constructor(map, done) {
    this.map = map;
    this.done = done;
    this.armed = false;
    map.getContainer().addEventListener('pointerdown', (event) => this.begin(event), { capture: true });
  }

  arm(armed = true) {
    this.armed = armed;
    this.map.getContainer().classList.toggle('selecting', armed);
    this.map.dragging[armed ? 'disable' : 'enable']();
  }

  begin(event) {
    if (event.button !== 0 || !(event.shiftKey || this.armed) || event.target.closest('.leaflet-control')) return;
    event.preventDefault();
    event.stopPropagation();
    const container = this.map.getContainer();
    const start = this.map.mouseEventToContainerPoint(event);
    const box = element('div.rubber');
    container.append(box);
    container.setPointerCapture(event.pointerId);

    const move = (moved) => this.place(box, L.bounds(start, this.map.mouseEventToContainerPoint(moved)));
    const end = (ended, accepted) => {
      container.removeEventListener('pointermove', move);
      container.removeEventListener('pointerup', up);
      container.removeEventListener('pointercancel', cancel);
      box.remove();
      this.arm(false);
      if (accepted) this.finish(L.bounds(start, this.map.mouseEventToContainerPoint(ended)));
    };
    const up = (ended) => end(ended, true);
    const cancel = (ended) => end(ended, false);
    container.addEventListener('pointermove', move);
    container.addEventListener('pointerup', up);
    container.addEventListener('pointercancel', cancel);
  }

  place(box, { min, max }) {
    Object.assign(box.style, { left: `${min.x}px`, top: `${min.y}px`, width: `${max.x - min.x}px`, height: `${max.y - min.y}px` });
  }

  finish(pixels) {
    const { x, y } = pixels.getSize();
    if (x < LEAST_PIXELS || y < LEAST_PIXELS) return;
    const corner = (point) => this.map.containerPointToLatLng(point);
    this.dragged = true;
    setTimeout(() => (this.dragged = false)); // the click that ends the drag asks for nothing else
    this.done(boxOf(L.latLngBounds(corner(pixels.min), corner(pixels.max))));
  }
}
