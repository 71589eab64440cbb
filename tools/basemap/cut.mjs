// Cut lines and rings at the antimeridian: a step of more than 180 degrees of longitude crosses it.

// The same points with longitudes that run on (170, 175, 185) instead of jumping.
function unwrap(points) {
  let turn = 0;
  return points.map(([lon, lat], i) => {
    if (i && Math.abs(lon - points[i - 1][0]) > 180) turn += lon < points[i - 1][0] ? 360 : -360;
    return [lon + turn, lat];
  });
}

const between = ([x0, y0], [x1, y1], x) => [x, y0 + (y1 - y0) * (x - x0) / (x1 - x0)];

// What of a ring lies on one side of a meridian (Sutherland and Hodgman): sign 1 keeps the east, -1 the west.
function clip(ring, meridian, sign) {
  const inside = ([x]) => sign * (x - meridian) >= 0;
  return ring.flatMap((point, i) => {
    const before = ring.at(i - 1);
    const crossing = inside(point) !== inside(before) ? [between(before, point, meridian)] : [];
    return inside(point) ? [...crossing, point] : crossing;
  });
}

const worlds = (points) => {
  const turns = points.map(([lon]) => Math.floor((lon + 180) / 360));
  const first = Math.min(...turns);
  return Array.from({ length: Math.max(...turns) - first + 1 }, (_, i) => 360 * (first + i));
};

const shifted = (points, by) => points.map(([lon, lat]) => [lon - by, lat]);

// A ring as rings within -180..180, each closed. One that runs around the pole is closed along the pole's parallel.
export function cutRing(ring) {
  const points = unwrap(ring);
  const [first, last] = [points[0], points.at(-1)];
  if (Math.abs(last[0] - first[0]) > 180) {
    const pole = first[1] < 0 ? -90 : 90;
    points.push([last[0], pole], [first[0], pole]);
  }
  return worlds(points)
    .map((turn) => shifted(clip(clip(points, turn - 180, 1), turn + 180, -1), turn))
    .filter((part) => part.length > 3)
    .map((part) => [...part, part[0]]);
}

// A line as lines within -180..180.
export function cutLine(line) {
  const parts = [[]];
  unwrap(line).forEach((point, i, all) => {
    const turn = (lon) => Math.floor((lon + 180) / 360);
    if (i && turn(point[0]) !== turn(all[i - 1][0])) {
      const meridian = 360 * Math.max(turn(point[0]), turn(all[i - 1][0])) - 180;
      const crossing = between(all[i - 1], point, meridian);
      parts.at(-1).push(crossing);
      parts.push([crossing]);
    }
    parts.at(-1).push(point);
  });
  const middle = (part) => (part[0][0] + part.at(-1)[0]) / 2; // strictly within a world, where the ends may lie on its edge
  return parts.map((part) => shifted(part, 360 * Math.floor((middle(part) + 180) / 360)));
}
