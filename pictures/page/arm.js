// SPDX-License-Identifier: BSD-3-Clause
// An arm that moves: in its projections, and in perspective, where a ray a pixel finds what is nearest to the eye. What
// stands still is found once for a view; then each moment asks the links' rays alone.
"use strict";
const arm = picture.arm ? {...picture.arm, spheres: numbers(picture.arm.spheres), boxes: numbers(picture.arm.boxes), faces: numbers(picture.arm.faces),
  links: numbers(picture.arm.links), frames: numbers(picture.arm.frames), spines: numbers(picture.arm.spines),
  tools: numbers(picture.arm.tools), moments: numbers(picture.arm.moments), turned: 0} : null;
const shadowSide = 256;
const cross3 = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const rgb = color => [1, 3, 5].map(i => parseInt(color.slice(i, i + 2), 16));

/// n numbers of each moment, at one between them.
function numbersAt(all, n, share) {
  let low = 0, high = arm.moments.length - 1;
  while (high - low > 1) { const middle = (low + high) >> 1; if (arm.moments[middle] <= share) low = middle; else high = middle; }
  const a = all.subarray(n * low, n * low + n), b = all.subarray(n * high, n * high + n);
  const t = high > low ? Math.min(1, Math.max(0, (share - arm.moments[low]) / (arm.moments[high] - arm.moments[low]))) : 0;
  return a.map((v, i) => v + t * (b[i] - v));
}
/// A line through the joints at a moment: x, y, z, ...
const spineAt = share => numbersAt(arm.spines, 3 * arm.ends, share);
/// The links at a moment: balls that go from a to b, faces a, b, c. Of each frame: where its axes point, and its origin.
function linksAt(share, by, color) {
  const f = numbersAt(arm.frames, 12 * arm.joints, share), all = [], ink = rgb(shade(color));
  for (let i = 0; i < arm.links.length; i += 11) {
    const o = 12 * arm.links[i], r = arm.links[i + 1];
    const at = k => [0, 1, 2].map(d => f[o + 9 + d] + f[o + d] * arm.links[i + k] + f[o + 3 + d] * arm.links[i + k + 1] + f[o + 6 + d] * arm.links[i + k + 2]);
    all.push(r < 0 ? {a: at(2), b: at(5), c: at(8), r, color: ink} : {a: at(2), b: at(5), r: Math.max(by * r, arm.least), color: ink});
  }
  return all;
}
/// Balls that go along a line of points.
function tubes(points, radius, color) {
  const r = Math.max(radius, arm.least), all = [];
  for (let i = 3; i < points.length; i += 3) all.push({a: [...points.slice(i - 3, i)], b: [...points.slice(i, i + 3)], r, color: rgb(shade(color))});
  return all;
}
function solidsThatStand() {
  const all = [], grey = rgb(isDark() ? "#94a3b8" : arm.colors.solid);
  for (let i = 0; i < arm.spheres.length; i += 4) { const c = [...arm.spheres.slice(i, i + 3)]; all.push({a: c, b: c, r: arm.spheres[i + 3], color: grey}); }
  for (let i = 0; i < arm.boxes.length; i += 6) all.push({a: [...arm.boxes.slice(i, i + 3)], b: [...arm.boxes.slice(i + 3, i + 6)], r: -1, color: grey});
  for (let i = 0; i < arm.faces.length; i += 9) all.push({a: [...arm.faces.slice(i, i + 3)], b: [...arm.faces.slice(i + 3, i + 6)], c: [...arm.faces.slice(i + 6, i + 9)], r: -1, color: grey});
  if (arm.moments.length > 1) all.push(...linksAt(1, 1, arm.colors.goal), ...tubes(arm.tools, 0.2 * arm.radius, picture.pathColor));
  return [...all, ...linksAt(0, 1, arm.colors.start)];
}

const enterBall = (eye, ray, c, r) => {
  const x = eye[0] - c[0], y = eye[1] - c[1], z = eye[2] - c[2], b = x * ray[0] + y * ray[1] + z * ray[2], root = b * b - x * x - y * y - z * z + r * r;
  return root < 0 ? Infinity : -b - Math.sqrt(root);
};
/// Of a face: what its sides and all of it span with the eye; below 0 where it is seen.
function takeSides(eye, s) {
  const [a, b, c] = [s.a, s.b, s.c].map(p => p.map((v, k) => v - eye[k]));
  s.sides = [cross3(b, c), cross3(c, a), cross3(a, b)];
  s.volume = dot3(a, s.sides[0]);
}
function enterSolid(eye, ray, s) {
  if (s.c) {
    const [a, b, c] = s.sides.map(side => dot3(ray, side));
    return a <= 0 && b <= 0 && c <= 0 ? s.volume / (a + b + c) : Infinity;
  }
  if (s.r < 0) {
    let from = -Infinity, to = Infinity;
    for (let k = 0; k < 3; ++k) {
      const one = (s.a[k] - eye[k]) / ray[k], two = (s.b[k] - eye[k]) / ray[k];
      from = Math.max(from, Math.min(one, two));
      to = Math.min(to, Math.max(one, two));
    }
    return from <= to ? from : Infinity;
  }
  const w = [s.b[0] - s.a[0], s.b[1] - s.a[1], s.b[2] - s.a[2]], sq = dot3(w, w);
  if (sq > 0) {
    const off = [eye[0] - s.a[0], eye[1] - s.a[1], eye[2] - s.a[2]], wr = dot3(w, ray), wo = dot3(w, off);
    const a = sq - wr * wr, b = sq * dot3(ray, off) - wo * wr, root = b * b - a * (sq * (dot3(off, off) - s.r * s.r) - wo * wo);
    if (a > 0 && root >= 0) {
      const t = (-b - Math.sqrt(root)) / a, at = wo + t * wr;
      if (at > 0 && at < sq) return t;
    }
    return Math.min(enterBall(eye, ray, s.a, s.r), enterBall(eye, ray, s.b, s.r));
  }
  return enterBall(eye, ray, s.a, s.r);
}
function normalOf(p, s) {
  if (s.c) {
    const n = cross3(s.b.map((v, k) => v - s.a[k]), s.c.map((v, k) => v - s.a[k])), length = Math.sqrt(dot3(n, n));
    return n.map(v => v / length);
  }
  if (s.r < 0) {
    const shares = [0, 1, 2].map(k => (2 * p[k] - s.a[k] - s.b[k]) / (s.b[k] - s.a[k] || 1)), face = shares.reduce((best, v, k) => Math.abs(v) > Math.abs(shares[best]) ? k : best, 0);
    return [0, 1, 2].map(k => k === face ? Math.sign(shares[k]) : 0);
  }
  const w = [0, 1, 2].map(k => s.b[k] - s.a[k]), sq = dot3(w, w), off = [0, 1, 2].map(k => p[k] - s.a[k]);
  const t = sq > 0 ? Math.min(1, Math.max(0, dot3(w, off) / sq)) : 0;
  return off.map((v, k) => (v - t * w[k]) / s.r);
}

/// An eye that looks at the solids, with `side` rays across.
class Eye {
  constructor(side) {
    const far = 3.2 * arm.reach, azimuth = arm.azimuth + arm.turned, c = Math.cos(azimuth), s = Math.sin(azimuth), up = Math.sin(arm.rise), flat = Math.cos(arm.rise);
    this.side = side;
    this.at = [far * flat * c, far * flat * s, far * up];
    this.forward = [-flat * c, -flat * s, -up];
    this.right = [-s, c, 0];
    this.up = [-up * c, -up * s, flat];
    this.zoom = side / 2 * Math.sqrt(3.2 * 3.2 - 1);
    this.light = [0, 1, 2].map(k => -0.45 * this.right[k] - 0.6 * this.forward[k] + (k === 2 ? 0.75 : 0));
    const length = Math.sqrt(dot3(this.light, this.light));
    this.light = this.light.map(v => v / length);
    this.depth = new Float32Array(side * side).fill(Infinity);
    this.image = new ImageData(side, side);
    this.floor = new Int32Array(side * side).fill(-1);  // of each ray that meets none: the place of the shadow that it sees
    this.paper = rgb(paper());
  }
  ray(x, y) {
    const u = (x + 0.5 - this.side / 2) / this.zoom, v = (this.side / 2 - y - 0.5) / this.zoom, r = [0, 0, 0];
    for (let k = 0; k < 3; ++k) r[k] = this.forward[k] + u * this.right[k] + v * this.up[k];
    const length = Math.sqrt(dot3(r, r));
    return r.map(e => e / length);
  }
  /// What is far is paler.
  put(i, color, bright, gloss, depth) {
    const air = 0.5 * Math.min(1, Math.max(0, 0.5 * (depth / arm.reach - 2.2))), to = this.image.data;
    for (let k = 0; k < 3; ++k) {
      const c = color[k] * bright + gloss * (255 - color[k] * bright);
      to[4 * i + k] = c + air * (this.paper[k] - c);
    }
    to[4 * i + 3] = 255;
  }
  draw(s) {
    if (s.c) {
      takeSides(this.at, s);
      if (!(s.volume < 0)) return;
    }
    const seen = p => { const off = p.map((v, k) => v - this.at[k]), z = Math.max(dot3(this.forward, off), 1e-3 * arm.reach); return [this.side / 2 + this.zoom * dot3(this.right, off) / z, this.side / 2 - this.zoom * dot3(this.up, off) / z, z]; };
    const corners = s.c ? [s.a, s.b, s.c].map(seen) : s.r < 0 ? Array.from({length: 8}, (_, i) => seen([i & 1 ? s.a[0] : s.b[0], i & 2 ? s.a[1] : s.b[1], i & 4 ? s.a[2] : s.b[2]])) : [seen(s.a), seen(s.b)];
    const room = s.r < 0 ? 1 : Math.max(...corners.map(c => 1.25 * this.zoom * s.r / Math.max(c[2] - s.r, 1e-3 * arm.reach))) + 1;
    const reach = axis => [Math.max(0, Math.floor(Math.min(...corners.map(c => c[axis])) - room)), Math.min(this.side, Math.ceil(Math.max(...corners.map(c => c[axis])) + room))];
    const [x0, x1] = reach(0), [y0, y1] = reach(1);
    const edges = (s.c ? s.sides : []).map(side => [dot3(side, this.forward), dot3(side, this.right) / this.zoom, dot3(side, this.up) / this.zoom]);
    for (let y = y0; y < y1; ++y) {
      for (let x = x0; x < x1; ++x) {
        if (edges.some(e => e[0] + e[1] * (x + 0.5 - this.side / 2) + e[2] * (this.side / 2 - y - 0.5) > 0)) continue;
        const ray = this.ray(x, y), t = Math.fround(enterSolid(this.at, ray, s)), i = y * this.side + x;
        if (!(t > 0 && t < this.depth[i])) continue;
        this.depth[i] = t;
        this.floor[i] = -1;
        const normal = normalOf(ray.map((v, k) => this.at[k] + t * v), s), half = ray.map((v, k) => this.light[k] - v);
        const glance = Math.max(0, dot3(normal, half) / Math.sqrt(dot3(half, half)));
        this.put(i, s.color, 0.5 + 0.5 * Math.max(0, dot3(normal, this.light)), 0.25 * glance ** 16, t);
      }
    }
  }
  drawFloor(shadows) {
    for (let y = 0; y < this.side; ++y) {
      for (let x = 0; x < this.side; ++x) {
        const i = y * this.side + x;
        if (this.depth[i] < Infinity) continue;
        const ray = this.ray(x, y), t = (arm.floor[2] - this.at[2]) / ray[2], px = this.at[0] + t * ray[0] - arm.floor[0], py = this.at[1] + t * ray[1] - arm.floor[1];
        if (!(t > 0 && px >= 0 && py >= 0 && px < arm.floorSide && py < arm.floorSide)) continue;
        const k = shadowSide / arm.floorSide;
        this.floor[i] = Math.floor(py * k) * shadowSide + Math.floor(px * k);
        const even = (Math.floor(px / arm.square) + Math.floor(py / arm.square)) % 2 === 0;
        const color = isDark() ? even ? [26, 37, 59] : [34, 47, 72] : even ? [244, 245, 247] : [232, 235, 239];
        this.put(i, color, 1 - 0.22 * shadows[this.floor[i]] / 255, 0, t);
      }
    }
  }
}
/// Of light that falls straight down: how dark each place of the floor is.
function shadowsOf(solids) {
  const context = new OffscreenCanvas(shadowSide, shadowSide).getContext("2d", {willReadFrequently: true}), k = shadowSide / arm.floorSide;
  context.lineCap = "round";
  for (const s of solids) {
    const at = p => [k * (p[0] - arm.floor[0]), k * (p[1] - arm.floor[1])], a = at(s.a), b = at(s.b);
    if (s.c) {
      context.beginPath();
      for (const p of [a, b, at(s.c)]) context.lineTo(...p);
      context.fill();
      continue;
    }
    if (s.r < 0) { context.fillRect(...a, b[0] - a[0], b[1] - a[1]); continue; }
    context.lineWidth = 2 * s.r * k;
    context.beginPath();
    context.moveTo(...a);
    context.lineTo(b[0] + 1e-3, b[1]);
    context.stroke();
  }
  const data = context.getImageData(0, 0, shadowSide, shadowSide).data;
  return Uint8Array.from({length: shadowSide * shadowSide}, (_, i) => data[4 * i + 3]);
}

/// What stands still, for this side, turn and theme; kept until one of them changes.
function eyeAtRest(side) {
  const key = `${side} ${arm.turned} ${isDark()}`;
  if (arm.key === key) return arm.eye;
  const solids = solidsThatStand();
  arm.key = key;
  arm.eye = new Eye(side);
  for (const s of solids) arm.eye.draw(s);
  arm.shadows = shadowsOf(solids);
  arm.eye.drawFloor(arm.shadows);
  return arm.eye;
}
function eyeAt(share, side) {
  const rest = eyeAtRest(side);
  if (!motion.isOn) return rest;
  const eye = Object.assign(Object.create(Eye.prototype), rest, {depth: rest.depth.slice(), floor: rest.floor.slice(), image: new ImageData(rest.image.data.slice(), side)});
  const links = linksAt(share, 1.02, arm.colors.moving), dark = shadowsOf(links);
  for (let i = 0; i < eye.floor.length; ++i) {
    const at = eye.floor[i];
    if (at < 0 || dark[at] <= arm.shadows[at]) continue;
    for (let k = 0; k < 3; ++k) eye.image.data[4 * i + k] *= (1 - 0.22 * dark[at] / 255) / (1 - 0.22 * arm.shadows[at] / 255);
  }
  for (const s of links) eye.draw(s);
  return eye;
}
function drawArm(context) {
  if (!arm) return;
  const [x0, y0, x1, y1] = arm.box, px = screenX(x0), py = screenY(y1), size = (x1 - x0) * view.scale;
  if (px < stage.clientWidth && py < stage.clientHeight && px + size > 0 && py + size > 0) {
    const side = Math.max(16, Math.min(motion.isOn ? 480 : 960, Math.round(size * ratio()))), canvas = new OffscreenCanvas(side, side);
    canvas.getContext("2d").putImageData(eyeAt(motion.share, side).image, 0, 0);
    context.drawImage(canvas, px, py, size, size);
  }
  if (!motion.isOn) return;
  const shapes = linksAt(motion.share, 1, arm.colors.moving);
  context.lineCap = context.lineJoin = "round";
  context.fillStyle = context.strokeStyle = shade(arm.colors.moving) + "99";
  for (const [right, up, x, y] of arm.views) {
    const at = p => [screenX(x + p[right]), screenY(y + p[up])], lines = new Map(), faces = new Path2D();
    for (const s of shapes) {
      const [a, b, c] = [s.a, s.b, s.c ?? s.b].map(at);
      if (!s.c) {
        if (!lines.has(s.r)) lines.set(s.r, new Path2D());
        lines.get(s.r).moveTo(...a);
        lines.get(s.r).lineTo(b[0] + 1e-3, b[1]);
      } else if ((b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])) {  // half of the faces cover all that a body does
        faces.moveTo(...a);
        faces.lineTo(...b);
        faces.lineTo(...c);
        faces.closePath();
      }
    }
    context.fill(faces);
    for (const [r, line] of lines) {
      context.lineWidth = Math.max(2 * r * view.scale, 2);
      context.stroke(line);
    }
  }
}
