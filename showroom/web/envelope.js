// SPDX-License-Identifier: GPL-3.0-or-later
// How far a surface reaches from the trunk's upright axis: a grid of height x angle that true triangles are laid into.

const STEP = 0.004; // [m] between rows
const COLUMNS = 288; // about 4 mm at a waist
const TURN = 2 * Math.PI;

/** Angle and radius of (x, z) around the axis {x, z}; the angle in [0, COLUMNS). */
export function polar(axis, x, z) {
  const dx = x - axis.x, dz = z - axis.z, turn = Math.atan2(dx, dz) / TURN;
  return { column: (turn < 0 ? turn + 1 : turn) * COLUMNS, r: Math.hypot(dx, dz) };
}

export class Envelope {
  /** An empty grid between the heights `low` and `high` [m]. */
  constructor(axis, low, high) {
    this.axis = axis;
    this.low = low - 3 * STEP;
    this.rows = Math.ceil((high - this.low) / STEP) + 4;
    this.high = this.low + this.rows * STEP;
    this.reach = new Float32Array(this.rows * COLUMNS); // 0: nothing is here
  }

  /**
   * Lays in the triangles for which `wanted(corner, corner, corner)` holds, point by point, half a cell apart, so that
   * folds count as they are and not as their corners.
   */
  add(positions, triangles, wanted) {
    const { axis, low, high, rows, reach } = this;
    for (let t = 0; t < triangles.length; t += 3) {
      const ids = [triangles[t], triangles[t + 1], triangles[t + 2]];
      const [a, b, c] = ids.map((v) => 3 * v), p = positions;
      const ya = p[a + 1], yb = p[b + 1], yc = p[c + 1];
      if (Math.max(ya, yb, yc) < low || Math.min(ya, yb, yc) > high || !wanted(...ids)) continue;
      const long = Math.max(
        Math.hypot(p[a] - p[b], ya - yb, p[a + 2] - p[b + 2]),
        Math.hypot(p[b] - p[c], yb - yc, p[b + 2] - p[c + 2]),
        Math.hypot(p[c] - p[a], yc - ya, p[c + 2] - p[a + 2]),
      );
      const n = Math.max(1, Math.ceil(long / (0.5 * STEP)));
      for (let i = 0; i <= n; ++i)
        for (let j = 0; i + j <= n; ++j) {
          const u = i / n, v = j / n, w = 1 - u - v;
          const row = Math.floor((u * ya + v * yb + w * yc - low) / STEP);
          if (row < 0 || row >= rows) continue;
          const at = polar(axis, u * p[a] + v * p[b] + w * p[c], u * p[a + 2] + v * p[b + 2] + w * p[c + 2]);
          const cell = row * COLUMNS + (Math.floor(at.column) % COLUMNS);
          if (at.r > reach[cell]) reach[cell] = at.r;
        }
    }
    return this;
  }

  /**
   * Every cell takes the furthest reach within two cells, then the nearest of those: what the points left open between
   * them is closed, and so are creases narrower than cloth can follow, but a slope stays where it is. The grid ends two cells
   * beyond what was laid in.
   */
  close() {
    for (const furthest of [true, false])
      for (const along of [1, COLUMNS]) {
        const from = this.reach, to = new Float32Array(from.length);
        for (let row = 0; row < this.rows; ++row)
          for (let column = 0; column < COLUMNS; ++column) {
            let best = 0;
            for (let k = -2; k <= 2; ++k) {
              const r = along === 1 ? row : row + k, c = along === 1 ? (column + k + COLUMNS) % COLUMNS : column;
              const reach = r < 0 || r >= this.rows ? 0 : from[r * COLUMNS + c];
              if (reach > 0 && (best === 0 || reach > best === furthest)) best = reach;
            }
            if (furthest || from[row * COLUMNS + column] > 0) to[row * COLUMNS + column] = best;
          }
        this.reach = to;
      }
    return this;
  }

  /** The reach [m] at a height and an angle, between cells; 0 where nothing is. */
  at(y, column) {
    const fy = (y - this.low) / STEP - 0.5, fx = column - 0.5 + COLUMNS;
    const row = Math.floor(fy), left = Math.floor(fx);
    let sum = 0, weight = 0;
    for (let i = 0; i < 2; ++i) {
      if (row + i < 0 || row + i >= this.rows) continue;
      const wy = i ? fy - row : 1 - (fy - row);
      for (let j = 0; j < 2; ++j) {
        const r = this.reach[(row + i) * COLUMNS + ((left + j) % COLUMNS)];
        const w = wy * (j ? fx - left : 1 - (fx - left));
        if (r > 0) {
          sum += w * r;
          weight += w;
        }
      }
    }
    return weight > 1e-6 ? sum / weight : 0;
  }

  /** For each column the height [m] of the highest cell that is filled, evened out over a few degrees. */
  upperEdge() {
    const edge = new Float32Array(COLUMNS).fill(-Infinity);
    for (let column = 0; column < COLUMNS; ++column)
      for (let row = this.rows - 1; row >= 0 && edge[column] === -Infinity; --row)
        if (this.reach[row * COLUMNS + column] > 0) edge[column] = this.low + (row + 0.5) * STEP;
    return edge.map((_, column) => {
      let sum = 0, count = 0;
      for (let k = -4; k <= 4; ++k) {
        const y = edge[(column + k + COLUMNS) % COLUMNS];
        if (y > -Infinity) (sum += y), ++count;
      }
      return count ? sum / count : -Infinity;
    });
  }
}
