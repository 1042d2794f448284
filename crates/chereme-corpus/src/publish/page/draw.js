// Drawing: the skin on its bones with WebGL 2, or triangle by triangle on a plain canvas where a browser has none.

// The paper of the still pictures.
const PAPER = [244, 245, 247];

// The eye and its axes: a camera of the movement, turned about its target and brought nearer.
function sightOf(camera, turn, mirror, aspect) {
  const sight = less(camera.target, camera.eye);
  const far = Math.hypot(...sight);
  let ahead = unit(sight);
  let right = unit(cross(ahead, camera.up));
  const about = (axis, angle) => (v) => quat.moves([...scaled(axis, Math.sin(angle / 2)), Math.cos(angle / 2)], v);
  [ahead, right] = [ahead, right].map(about(unit(camera.up), turn.yaw));
  ahead = about(right, turn.pitch)(ahead);
  const zoom = (far / camera.half) * turn.zoom;
  return { eye: less(camera.target, scaled(ahead, far)), right, up: cross(right, ahead), ahead,
    lens: [(mirror ? -zoom : zoom) / aspect, zoom, Math.max(0.05, far - 2.5), far + 2.5] };
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

// The surface of a body, read from its numbers once.
function surfaceOf(it) {
  if (it.surface) return it.surface;
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
  it.surface = { place, normal, colour: together(colours, 1 / 255), bone: together(bones, 1), weight: together(weights, 1 / 255), corners };
  return it.surface;
}

// The changes of a body's face: see FaceMorph in portable.rs.
function readMorphs(it) {
  if (!it.read) {
    const numbers = new Numbers(it.data);
    it.read = it.morphs.map((morph) => ({ ...morph, vertices: numbers.row(morph.l), offsets: Array.from({ length: 3 }, () => numbers.row(morph.l)) }));
  }
  return it.read;
}

// The places of all vertices with an expression of the face.
function shapedPlaces(body, face) {
  const surface = surfaceOf(body);
  const shown = body.face ? face.filter(([, value]) => value !== 0) : [];
  if (!shown.length && !surface.shaped) return surface.place;
  surface.shaped = surface.shaped || surface.place.slice();
  surface.shaped.set(surface.place);
  for (const [number, value] of shown) {
    for (const morph of readMorphs(body.face)) {
      if (morph.n !== number || morph.s * value <= 0) continue;
      const share = Math.min(1, Math.abs(value)) / 4000;
      for (let at = 0; at < morph.l; at += 1) for (let axis = 0; axis < 3; axis += 1) surface.shaped[3 * morph.vertices[at] + axis] += share * morph.offsets[axis][at];
    }
  }
  return surface.shaped;
}

// Draws bodies on a canvas; bodies stay with the renderer, so that many movements of one body take its surface once.
function makeRenderer(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) return makePainter(canvas);
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
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.NEAREST], [gl.TEXTURE_MAG_FILTER, gl.NEAREST], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, key, value);
  gl.enable(gl.DEPTH_TEST);
  const uniforms = Object.fromEntries(["eye", "right", "up", "ahead", "lens"].map((name) => [name, gl.getUniformLocation(program, name)]));
  const skins = new Map();
  const skinOf = (body) => {
    if (skins.has(body)) return skins.get(body);
    const surface = surfaceOf(body);
    const skin = { surface, array: gl.createVertexArray(), place: null, corners: surface.corners.length, numbers: new Float32Array(12 * body.bones.length) };
    gl.bindVertexArray(skin.array);
    for (const [name, size] of [["place", 3], ["normal", 3], ["colour", 3], ["bone", 4], ["weight", 4]]) {
      const at = gl.getAttribLocation(program, name);
      const buffer = gl.createBuffer();
      if (name === "place") skin.place = buffer;
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, surface[name], gl.STATIC_DRAW);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, surface.corners, gl.STATIC_DRAW);
    skins.set(body, skin);
    return skin;
  };
  const draw = (body, motions, face, sight) => {
    const skin = skinOf(body);
    gl.bindVertexArray(skin.array);
    const places = shapedPlaces(body, face);
    if (places !== skin.surface.place) {
      gl.bindBuffer(gl.ARRAY_BUFFER, skin.place);
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, places);
    }
    motions.forEach((motion, index) => skin.numbers.set(rows(motion).flat(), 12 * index));
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 3, body.bones.length, 0, gl.RGBA, gl.FLOAT, skin.numbers);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...PAPER.map((part) => part / 255), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    for (const name of ["eye", "right", "up", "ahead"]) gl.uniform3fv(uniforms[name], sight[name]);
    gl.uniform4fv(uniforms.lens, sight.lens);
    gl.drawElements(gl.TRIANGLES, skin.corners, gl.UNSIGNED_INT, 0);
  };
  return { canvas, draw, isSlow: false };
}

// The same picture without WebGL: the far triangles first, each in one colour.
function makePainter(canvas) {
  const paper = canvas.getContext("2d");
  if (!paper) return null;
  const draw = (body, motions, face, sight) => {
    const { colour, bone, weight, corners } = surfaceOf(body);
    const place = shapedPlaces(body, face);
    const matrices = motions.map((motion) => rows(motion).flat());
    const spots = new Float32Array(place.length);
    const seen = new Float32Array(place.length);
    const { eye, right, up, ahead, lens } = sight;
    for (let at = 0; at < place.length; at += 3) {
      const slots = (4 * at) / 3;
      let [x, y, z] = [0, 0, 0];
      for (let slot = slots; slot < slots + 4; slot += 1) {
        const share = weight[slot];
        if (!share) continue;
        const m = matrices[bone[slot]];
        x += share * (m[0] * place[at] + m[1] * place[at + 1] + m[2] * place[at + 2] + m[3]);
        y += share * (m[4] * place[at] + m[5] * place[at + 1] + m[6] * place[at + 2] + m[7]);
        z += share * (m[8] * place[at] + m[9] * place[at + 1] + m[10] * place[at + 2] + m[11]);
      }
      spots[at] = x; spots[at + 1] = y; spots[at + 2] = z;
      x -= eye[0]; y -= eye[1]; z -= eye[2];
      const depth = ahead[0] * x + ahead[1] * y + ahead[2] * z;
      seen[at] = (((right[0] * x + right[1] * y + right[2] * z) * lens[0]) / depth + 1) * canvas.width / 2;
      seen[at + 1] = (1 - ((up[0] * x + up[1] * y + up[2] * z) * lens[1]) / depth) * canvas.height / 2;
      seen[at + 2] = depth;
    }
    const mirrored = lens[0] < 0 ? -1 : 1;
    const depths = new Map();
    for (let at = 0; at < corners.length; at += 3) {
      const [a, b, c] = [3 * corners[at], 3 * corners[at + 1], 3 * corners[at + 2]];
      // Backs of triangles are behind others: the surface is closed.
      const facing = (seen[b] - seen[a]) * (seen[c + 1] - seen[a + 1]) - (seen[c] - seen[a]) * (seen[b + 1] - seen[a + 1]);
      if (facing * mirrored < 0) depths.set(at, seen[a + 2] + seen[b + 2] + seen[c + 2]);
    }
    const order = [...depths.keys()].sort((a, b) => depths.get(b) - depths.get(a));
    const lamp = unit(add(scaled(up, 0.75), add(scaled(right, -0.5), scaled(ahead, -0.65))));
    const point = (at) => [spots[at], spots[at + 1], spots[at + 2]];
    paper.fillStyle = `rgb(${PAPER})`;
    paper.fillRect(0, 0, canvas.width, canvas.height);
    for (const at of order) {
      const [a, b, c] = [3 * corners[at], 3 * corners[at + 1], 3 * corners[at + 2]];
      const first = point(a);
      const light = 255 * (0.5 + 0.5 * Math.max(0, dot(unit(cross(less(point(b), first), less(point(c), first))), lamp)));
      paper.fillStyle = `rgb(${Math.round(colour[a] * light)},${Math.round(colour[a + 1] * light)},${Math.round(colour[a + 2] * light)})`;
      paper.strokeStyle = paper.fillStyle;
      paper.beginPath();
      paper.moveTo(seen[a], seen[a + 1]);
      paper.lineTo(seen[b], seen[b + 1]);
      paper.lineTo(seen[c], seen[c + 1]);
      paper.fill();
      // Without a line of the same colour the paper shows between the triangles.
      paper.stroke();
    }
  };
  return { canvas, draw, isSlow: true };
}
