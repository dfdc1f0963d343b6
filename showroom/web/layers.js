// SPDX-License-Identifier: GPL-3.0-or-later
// One cloth over another: which part of a mesh goes round the trunk, and how it is moved from or towards the axis.
import { polar } from './envelope.js';

const SAMPLE = 0.005; // [m] between the points of a triangle that are looked at
const ENOUGH = 1e-4; // [m] a layer this near to where it has to be is there
const ROUNDS = 24, SWEEPS = 40;

/** Numbers equal positions alike: sewn points of two panels move as one. {of: number of each point, count}. */
export function weld(positions) {
  const numbers = new Map(), of = new Uint32Array(positions.length / 3);
  for (let v = 0; v < of.length; ++v) {
    const key = `${positions[3 * v]} ${positions[3 * v + 1]} ${positions[3 * v + 2]}`;
    if (!numbers.has(key)) numbers.set(key, numbers.size);
    of[v] = numbers.get(key);
  }
  return { of, count: numbers.size };
}

/** A mesh ready to be moved: its points as doubles by number, its triangles by number, its neighbours. */
export class Cloth {
  constructor(mesh) {
    this.mesh = mesh;
    this.points = weld(mesh.positions);
    this.positions = new Float64Array(3 * this.points.count);
    mesh.positions.forEach((x, i) => (this.positions[3 * this.points.of[(i / 3) | 0] + (i % 3)] = x));
    this.triangles = Array.from(mesh.triangles, (v) => this.points.of[v]);
    this.moved = new Uint8Array(this.points.count);
    this.around = Array.from({ length: this.points.count }, () => new Set());
    for (let t = 0; t < this.triangles.length; t += 3)
      for (let i = 0; i < 3; ++i) {
        const a = this.triangles[t + i], b = this.triangles[t + ((i + 1) % 3)];
        if (a !== b) this.around[a].add(b), this.around[b].add(a);
      }
  }

  /** Heights of the lowest and the highest point [m]. */
  heights() {
    let low = Infinity, high = -Infinity;
    for (let v = 1; v < this.positions.length; v += 3) {
      low = Math.min(low, this.positions[v]);
      high = Math.max(high, this.positions[v]);
    }
    return { low, high };
  }

  /**
   * Marks the points below `high` [m] whose connected piece, cut off there, goes round the axis: the trunk's cloth, and
   * not that of a sleeve or an arm that hangs beside it.
   */
  roundTheAxis(axis, high) {
    const { positions: p, points } = this, piece = new Int32Array(points.count).fill(-1), mark = new Uint8Array(points.count);
    const bins = 36;
    for (let seed = 0; seed < points.count; ++seed) {
      if (piece[seed] >= 0 || p[3 * seed + 1] >= high) continue;
      const found = [seed], seen = new Uint8Array(bins);
      piece[seed] = seed;
      for (let k = 0; k < found.length; ++k) {
        const v = found[k], turn = Math.atan2(p[3 * v] - axis.x, p[3 * v + 2] - axis.z) / (2 * Math.PI);
        seen[Math.floor((turn + 1) * bins) % bins] = 1;
        for (const w of this.around[v])
          if (piece[w] < 0 && p[3 * w + 1] < high) {
            piece[w] = seed;
            found.push(w);
          }
      }
      // Coarse cloth leaves gaps between its points; a sleeve beside the trunk covers less than half a turn.
      if (seen.reduce((a, b) => a + b) > 0.6 * bins) for (const v of found) mark[v] = 1;
    }
    return mark;
  }

  /** Moves a point along its radius by `by` [m]. */
  moveOut(v, axis, by) {
    const dx = this.positions[3 * v] - axis.x, dz = this.positions[3 * v + 2] - axis.z, r = Math.hypot(dx, dz);
    if (by === 0 || r < 1e-9) return;
    this.positions[3 * v] += (by * dx) / r;
    this.positions[3 * v + 2] += (by * dz) / r;
    this.moved[v] = 1;
  }

  /** Every edge once with the length [m] that it has now. */
  edges() {
    const edges = [], p = this.positions;
    this.around.forEach((others, a) => {
      for (const b of others)
        if (a < b) edges.push([a, b, Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2])]);
    });
    return edges;
  }

  /** Shortens edges that are more than `limit` times as long as `edges` has them, by moving the points that are `free`. */
  slacken(edges, limit, free, sweeps) {
    const p = this.positions;
    for (let sweep = 0; sweep < sweeps; ++sweep)
      for (const [a, b, rest] of edges) {
        const parts = free[a] + free[b];
        if (parts === 0) continue;
        const d = [0, 1, 2].map((i) => p[3 * b + i] - p[3 * a + i]), length = Math.hypot(...d);
        if (length <= limit * rest) continue;
        const share = (length - limit * rest) / length / parts;
        for (let i = 0; i < 3; ++i) {
          p[3 * a + i] += free[a] * share * d[i];
          p[3 * b + i] -= free[b] * share * d[i];
        }
        this.moved[a] |= free[a];
        this.moved[b] |= free[b];
      }
  }

  /**
   * Moves the cloth out along its radii until it stands `gap` [m] beyond the envelope, and no further than it needs:
   * the offsets are a membrane stretched over what is needed, held at 0 where `free` is not set. `bound` marks the points
   * whose triangles are looked at, all over and not in their corners alone. Returns {most, short}: the largest offset and by how
   * much it is still wanting [m].
   */
  pushOut(envelope, gap, bound, free) {
    const { axis } = envelope, p = this.positions, n = this.points.count;
    const samples = this.#samples(envelope, bound);
    const needed = new Float64Array(n), offset = new Float64Array(n), out = new Float64Array(2 * n);
    const active = [];
    for (let v = 0; v < n; ++v) {
      const dx = p[3 * v] - axis.x, dz = p[3 * v + 2] - axis.z, r = Math.hypot(dx, dz) || 1;
      out[2 * v] = dx / r;
      out[2 * v + 1] = dz / r;
      if (free[v]) active.push([v, [...this.around[v]]]);
    }
    const reversed = [...active].reverse(); // sweeps from both ends carry as far
    let short = Infinity;
    for (let round = 0; round < ROUNDS && short > ENOUGH; ++round) {
      short = 0;
      for (const { ids, w, y } of samples) {
        let x = 0, z = 0, squares = 0;
        for (let i = 0; i < 3; ++i) {
          const v = ids[i];
          x += w[i] * (p[3 * v] + offset[v] * out[2 * v]);
          z += w[i] * (p[3 * v + 2] + offset[v] * out[2 * v + 1]);
          if (free[v]) squares += w[i] * w[i];
        }
        const at = polar(axis, x, z), reach = envelope.at(y, at.column), wanting = reach + gap - at.r;
        if (reach === 0 || wanting <= 0 || squares === 0) continue;
        short = Math.max(short, wanting);
        for (let i = 0; i < 3; ++i)
          if (free[ids[i]])
            needed[ids[i]] = Math.max(needed[ids[i]], offset[ids[i]] + (wanting * w[i]) / squares);
      }
      if (short === 0) break;
      for (let sweep = 0; sweep < SWEEPS; ++sweep)
        for (const [v, around] of sweep % 2 ? active : reversed) {
          let sum = 0;
          for (const w of around) sum += offset[w];
          offset[v] = Math.max(needed[v], around.length ? sum / around.length : 0);
        }
    }
    let most = 0;
    for (let v = 0; v < n; ++v) {
      most = Math.max(most, offset[v]);
      this.moveOut(v, axis, offset[v]);
    }
    return { most, short };
  }

  /** Points all over the triangles that `bound` marks and that lie where the envelope has something: {ids, w, y}. */
  #samples(envelope, bound) {
    const p = this.positions, samples = [], ends = [envelope.low, envelope.high];
    for (let t = 0; t < this.triangles.length; t += 3) {
      const ids = this.triangles.slice(t, t + 3);
      if (!ids.every((v) => bound[v]) || ids.every((v) => p[3 * v + 1] > ends[1]) || ids.every((v) => p[3 * v + 1] < ends[0])) continue;
      const long = Math.max(...ids.map((a, i) => {
        const b = ids[(i + 1) % 3];
        return Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]);
      }));
      const n = Math.max(1, Math.ceil(long / SAMPLE));
      for (let i = 0; i <= n; ++i)
        for (let j = 0; i + j <= n; ++j) {
          const w = [i / n, j / n, 1 - (i + j) / n];
          samples.push({ ids, w, y: w[0] * p[3 * ids[0] + 1] + w[1] * p[3 * ids[1] + 1] + w[2] * p[3 * ids[2] + 1] });
        }
    }
    return samples;
  }

  /** Takes out the triangles whose three points `hidden` marks; the rest keeps its points. */
  leaveOut(hidden) {
    const kept = [];
    for (let t = 0; t < this.triangles.length; t += 3)
      if (!(hidden[this.triangles[t]] && hidden[this.triangles[t + 1]] && hidden[this.triangles[t + 2]])) kept.push(t);
    const pick = (list) => kept.flatMap((t) => [list[t], list[t + 1], list[t + 2]]);
    const before = this.triangles.length / 3;
    const triangles = pick(this.mesh.triangles);
    this.triangles = pick(this.triangles);
    this.mesh.triangles = this.mesh.triangles.constructor.from(triangles);
    return before - kept.length;
  }

  /**
   * Writes what moved back into the mesh: positions, and the normals of moved points and their neighbours, weighted by
   * area over sewn points together, as the exporter makes them. All other bytes stay.
   */
  write() {
    const { mesh, points, positions: p } = this, normals = new Float64Array(3 * points.count);
    const touched = this.moved.slice();
    this.moved.forEach((m, v) => m && this.around[v].forEach((w) => (touched[w] = 1)));
    for (let t = 0; t < this.triangles.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map((i) => 3 * this.triangles[t + i]);
      const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]], w = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      const n = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
      for (const v of [a, b, c]) for (let i = 0; i < 3; ++i) normals[v + i] += n[i];
    }
    points.of.forEach((g, v) => {
      if (this.moved[g]) for (let i = 0; i < 3; ++i) mesh.positions[3 * v + i] = p[3 * g + i];
      if (!touched[g]) return;
      const length = Math.hypot(normals[3 * g], normals[3 * g + 1], normals[3 * g + 2]);
      // A fold pressed flat has no normal of its own: the one from before is as good as any.
      if (length > 1e-18) for (let i = 0; i < 3; ++i) mesh.normals[3 * v + i] = normals[3 * g + i] / length;
    });
    return mesh;
  }
}
