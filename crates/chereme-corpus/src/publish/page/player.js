// The player: bones from numbers, and a skin drawn with WebGL 2. The formulas are those of portable.rs.

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
  return tracks;
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

const VERTEX = `#version 300 es
precision highp float;
in vec3 place; in vec3 normal; in vec3 colour; in vec4 bone; in vec4 weight;
uniform highp sampler2D bones; uniform vec3 eye, right, up, ahead; uniform vec4 lens;
out vec3 skin; out vec3 facing; out vec3 seen;
void main() {
  vec4 x = vec4(0.0), y = vec4(0.0), z = vec4(0.0);
  for (int at = 0; at < 4; at++) {
    int row = int(bone[at] + 0.5);
    x += texelFetch(bones, ivec2(0, row), 0) * weight[at];
    y += texelFetch(bones, ivec2(1, row), 0) * weight[at];
    z += texelFetch(bones, ivec2(2, row), 0) * weight[at];
  }
  vec4 own = vec4(place, 1.0);
  vec3 at = vec3(dot(x, own), dot(y, own), dot(z, own));
  facing = vec3(dot(x.xyz, normal), dot(y.xyz, normal), dot(z.xyz, normal));
  vec3 from = at - eye;
  float depth = dot(ahead, from);
  seen = -from;
  skin = colour;
  gl_Position = vec4(dot(right, from) * lens.x, dot(up, from) * lens.y, (depth - lens.z) / (lens.w - lens.z) * 2.0 * depth - depth, depth);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
in vec3 skin; in vec3 facing; in vec3 seen;
uniform vec3 right, up, ahead;
out vec4 colour;
void main() {
  vec3 n = normalize(facing), v = normalize(seen);
  if (dot(n, v) < 0.0) n = -n;
  vec3 key = normalize(up * 0.75 - right * 0.5 - ahead * 0.65), fill = normalize(right * 0.8 + up * 0.1 - ahead * 0.5);
  float light = 0.46 + 0.46 * max(0.0, dot(n, key)) + 0.16 * max(0.0, dot(n, fill));
  float rim = pow(1.0 - max(0.0, dot(n, v)), 3.0);
  colour = vec4(skin * light * (1.0 - 0.55 * rim), 1.0);
}`;

function readBody(it) {
  const numbers = new Numbers(it.data);
  const row = () => numbers.row(it.vertices);
  const rowsOf = (n) => Array.from({ length: n }, row);
  const places = rowsOf(3);
  const colours = rowsOf(3);
  const [bones, weights] = [[], []];
  for (let slot = 0; slot < 4; slot += 1) { bones.push(row()); weights.push(row()); }
  const corners = new Uint32Array(3 * it.triangles);
  let last = 0;
  for (let at = 0; at < corners.length; at += 1) { last += numbers.number(); corners[at] = last; }
  const together = (all, scale) => {
    const out = new Float32Array(it.vertices * all.length);
    for (let at = 0; at < it.vertices; at += 1) for (let part = 0; part < all.length; part += 1) out[at * all.length + part] = all[part][at] * scale;
    return out;
  };
  const place = together(places, 1 / 10000);
  const normal = new Float32Array(place.length);
  const point = (at) => [place[3 * at], place[3 * at + 1], place[3 * at + 2]];
  for (let at = 0; at < corners.length; at += 3) {
    const own = [corners[at], corners[at + 1], corners[at + 2]];
    const [a, b, c] = own.map(point);
    const n = cross(less(b, a), less(c, a));
    for (const vertex of own) for (let axis = 0; axis < 3; axis += 1) normal[3 * vertex + axis] += n[axis];
  }
  return { place, normal, colour: together(colours, 1 / 255), bone: together(bones, 1), weight: together(weights, 1 / 255), corners };
}

function makePlayer(canvas, body, it) {
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) return null;
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) { console.error(gl.getShaderInfoLog(shader)); return null; }
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  const surface = readBody(body);
  for (const [name, size] of [["place", 3], ["normal", 3], ["colour", 3], ["bone", 4], ["weight", 4]]) {
    const at = gl.getAttribLocation(program, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, surface[name], gl.STATIC_DRAW);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
  }
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, surface.corners, gl.STATIC_DRAW);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.NEAREST], [gl.TEXTURE_MAG_FILTER, gl.NEAREST], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, key, value);
  gl.enable(gl.DEPTH_TEST);
  const tracks = readMotion(body, it);
  const numbers = new Float32Array(12 * body.bones.length);
  const uniforms = Object.fromEntries(["eye", "right", "up", "ahead", "lens"].map((name) => [name, gl.getUniformLocation(program, name)]));
  const player = { canvas, playing: false, speed: 1, mirror: false, camera: "front", time: (it.frames - 1) / 2 };
  player.draw = () => {
    posed(body, tracks, it.frames, player.time).forEach((motion, index) => numbers.set(rows(motion).flat(), 12 * index));
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 3, body.bones.length, 0, gl.RGBA, gl.FLOAT, numbers);
    const camera = it.cameras[player.camera] || it.cameras.front;
    if (!camera) return;
    const sight = less(camera.target, camera.eye);
    const far = Math.hypot(...sight);
    const ahead = unit(sight);
    const right = unit(cross(ahead, camera.up));
    const up = cross(right, ahead);
    const zoom = far / camera.half;
    const aspect = canvas.width / canvas.height;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.957, 0.949, 0.933, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniform3fv(uniforms.eye, camera.eye);
    gl.uniform3fv(uniforms.right, right);
    gl.uniform3fv(uniforms.up, up);
    gl.uniform3fv(uniforms.ahead, ahead);
    gl.uniform4f(uniforms.lens, (player.mirror ? -zoom : zoom) / aspect, zoom, Math.max(0.05, far - 2.5), far + 2.5);
    gl.drawElements(gl.TRIANGLES, surface.corners.length, gl.UNSIGNED_INT, 0);
  };
  let before = null;
  let waiting = false;
  const wait = () => {
    if (!waiting) requestAnimationFrame(tick);
    waiting = true;
  };
  function tick(now) {
    waiting = false;
    if (!player.playing) { before = null; return; }
    // A pause of 0.4 s, with the last picture still, separates one round from the next.
    const rounds = it.frames - 1 + 0.4 * it.rate;
    if (before !== null) clock = (clock + (Math.min(now - before, 250) / 1000) * it.rate * player.speed) % rounds;
    before = now;
    player.time = Math.min(clock, it.frames - 1);
    player.draw();
    wait();
  }
  let clock = 0;
  let begun = false;
  player.play = (on) => {
    if (on && !player.playing) clock = begun && player.time < it.frames - 1.01 ? player.time : 0;
    begun = begun || on;
    player.playing = on;
    if (on) wait();
  };
  player.step = (by) => {
    player.playing = false;
    player.time = Math.min(Math.max(Math.round(player.time) + by, 0), it.frames - 1);
    player.draw();
  };
  player.draw();
  return player;
}
