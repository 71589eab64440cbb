// Move the map to a place: in flight, or at once for those who want less motion. What is flown to lies beside the panel.
import { calm } from './dom.js';
import { small } from './tabs.js';

const CLOSE = 12; // zoom at which a record is looked at
const FLIGHT = { duration: 1 }; // seconds

export function flyTo(map, { lat, lon }) {
  const zoom = Math.max(map.getZoom(), CLOSE);
  if (calm()) map.setView([lat, lon], zoom, { animate: false });
  else map.flyTo([lat, lon], zoom, FLIGHT);
}

export function flyToBounds(map, bounds, maxZoom) {
  const padding = small() ? {} : { paddingTopLeft: [40, 90], paddingBottomRight: [400, 120] };
  if (calm()) map.fitBounds(bounds, { maxZoom, ...padding, animate: false });
  else map.flyToBounds(bounds, { maxZoom, ...padding, ...FLIGHT });
}
