// The bones of a body in each frame, from numbers. The formulas are those of portable.rs.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const less = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => scaled(a, 1 / Math.max(Math.hypot(...a), 1e-9));
const quat = {
  times: (a, b) => [a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]],
  unit: (a) => { const n = 1 / Math.max(Math.hypot(...a), 1e-9); return [a[0] * n, a[1] * n, a[2] * n, a[3] * n]; },
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3],
  back: (a) => [-a[0], -a[1], -a[2], a[3]],
  moves: (q, v) => { const u = cross(q, v); return add(v, add(scaled(u, 2 * q[3]), scaled(cross(q, u), 2))); },
  mix: (a, b, share) => {
    let along = quat.dot(a, b);
    const sign = along < 0 ? -1 : 1;
    along = Math.min(1, along * sign);
    const angle = Math.acos(along);
    if (angle < 1e-4) return a;
    const [x, y] = [Math.sin((1 - share) * angle) / Math.sin(angle), (sign * Math.sin(share * angle)) / Math.sin(angle)];
    return quat.unit([a[0] * x + b[0] * y, a[1] * x + b[1] * y, a[2] * x + b[2] * y, a[3] * x + b[3] * y]);
  },
};

const moved = (motion, at) => add(quat.moves(motion.turn, less(at, motion.from)), motion.to);

function rows(motion) {
  const [x, y, z, w] = motion.turn;
  let m = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]];
  if (motion.stretch) {
    const [d, much] = motion.stretch;
    m = m.map((row) => { const along = dot(row, d) * (much - 1); return add(row, scaled(d, along)); });
  }
  return m.map((row, at) => [...row, motion.to[at] - dot(row, motion.from)]);
}

function half(parent, child, bone) {
  const other = quat.dot(parent.turn, child.turn) < 0 ? child.turn.map((it) => -it) : child.turn;
  const sum = parent.turn.map((it, at) => it + other[at]);
  const turn = quat.dot(sum, sum) > 1e-6 ? quat.unit(sum) : child.turn;
  const bend = quat.unit(quat.times(quat.back(parent.turn), other));
  const length = Math.hypot(bend[0], bend[1], bend[2]);
  let angle = 2 * Math.atan2(length, bend[3]);
  let axis = length > 1e-7 ? scaled(bend, 1 / length) : [1, 0, 0];
  if (angle < 0) { angle = -angle; axis = scaled(axis, -1); }
  const across = cross(axis, bone.l);
  let stretch = null;
  if (angle > 0.02 && dot(across, across) > 0.04) {
    const much = (1 - Math.cos(Math.min(angle, 2.4) / 2)) / (1 - Math.cos(Math.PI / 4));
    stretch = [unit(across), 1 + bone.w * much];
  }
  const to = rows(child).map((row) => dot(row, bone.a) + row[3]);
  return { turn, from: bone.a, to, stretch };
}

function readMotion(body, it) {
  const numbers = new Numbers(it.data);
  const keyed = body.bones.filter((bone) => "k" in bone).length;
  const tracks = [];
  for (let bone = 0; bone < keyed; bone += 1) tracks.push(Array.from({ length: 7 }, () => numbers.row(it.frames)));
  const face = (it.face || []).map((number) => [number, numbers.row(it.frames).map((value) => value / 100)]);
  return { tracks, face };
}

// The values of the face's numbers at a time, each with its number.
function faced(face, frames, time) {
  const a = Math.min(Math.floor(time), frames - 1);
  const b = Math.min(a + 1, frames - 1);
  return face.map(([number, row]) => [number, row[a] + (row[b] - row[a]) * (time - a)]);
}

function posed(body, tracks, frames, time) {
  const a = Math.min(Math.floor(time), frames - 1);
  const b = Math.min(a + 1, frames - 1);
  const share = time - a;
  const motions = new Array(body.bones.length);
  let next = 0;
  body.bones.forEach((bone, index) => {
    if (!("k" in bone)) return;
    const track = tracks[next];
    next += 1;
    const mix = (part) => track[part][a] + (track[part][b] - track[part][a]) * share;
    const turn = quat.unit([mix(0), mix(1), mix(2), mix(3)]);
    const off = [mix(4) / 5000, mix(5) / 5000, mix(6) / 5000];
    if (bone.k < 0) motions[index] = { turn, from: bone.f, to: off };
    else {
      const up = motions[bone.k];
      motions[index] = { turn: quat.times(up.turn, turn), from: bone.f, to: add(moved(up, bone.a), quat.moves(up.turn, off)) };
    }
  });
  body.bones.forEach((bone, index) => {
    if ("s" in bone) motions[index] = motions[bone.s];
    else if ("b" in bone) {
      const [one, two] = bone.b.map((it) => motions[it]);
      motions[index] = { turn: quat.mix(one.turn, two.turn, bone.t), from: one.from, to: one.to };
    } else if ("h" in bone) motions[index] = half(motions[bone.h[0]], motions[bone.h[1]], bone);
  });
  return motions;
}
