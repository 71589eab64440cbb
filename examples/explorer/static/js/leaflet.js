// Leaflet as a module: its file sets a global.
import '../vendor/leaflet/leaflet.js';

export default window.L;
