// The player: a movement in time, on any renderer.

// The pause between two rounds, with the last picture still, in seconds.
const ROUND_PAUSE = 0.4;

function makePlayer(renderer, body, it) {
  const { tracks, face } = readMotion(body, it);
  const last = it.frames - 1;
  const player = { renderer, frames: it.frames, rate: it.rate, playing: false, speed: 1, mirror: false, camera: "front",
    turn: { yaw: 0, pitch: 0, zoom: 1 }, time: last / 2, from: 0, to: last, beside: null, changed: () => {} };
  player.draw = () => {
    const camera = it.cameras[player.camera] || it.cameras.front;
    if (!camera) return;
    const { width, height } = renderer.canvas;
    renderer.draw(body, posed(body, tracks, it.frames, player.time), faced(face, it.frames, player.time), sightOf(camera, player.turn, player.mirror, width / height));
    const other = player.beside;
    if (other) {
      // In step: both begin and end together, however long each of them is.
      other.time = (player.time / Math.max(last, 1)) * (other.frames - 1);
      Object.assign(other, { mirror: player.mirror, camera: player.camera, turn: player.turn });
      other.draw();
    }
    player.changed();
  };
  // Lets `seconds` pass.
  player.pass = (seconds) => {
    const length = player.to - player.from;
    clock = (clock + seconds * it.rate * player.speed) % (length + ROUND_PAUSE * it.rate);
    player.time = player.from + Math.min(clock, length);
  };
  let clock = 0;
  let before = null;
  let waiting = false;
  let begun = false;
  const wait = () => {
    if (!waiting) requestAnimationFrame(tick);
    waiting = true;
  };
  function tick(now) {
    waiting = false;
    if (!player.playing) { before = null; return; }
    if (before !== null) player.pass(Math.min(now - before, 250) / 1000);
    before = now;
    player.draw();
    wait();
  }
  player.play = (on) => {
    if (on && !player.playing) clock = begun && player.time < player.to - 0.01 ? Math.max(0, player.time - player.from) : 0;
    begun = begun || on;
    player.playing = on;
    if (on) wait();
  };
  player.seek = (time) => {
    player.playing = false;
    begun = true;
    player.time = Math.min(Math.max(time, 0), last);
    player.draw();
  };
  player.step = (by) => player.seek(Math.round(player.time) + by);
  // Repeats a part; the whole without ends.
  player.part = (from = 0, to = last) => {
    [player.from, player.to] = [Math.min(from, to), Math.max(from, to)];
    clock = Math.min(Math.max(0, player.time - player.from), player.to - player.from);
    player.draw();
  };
  return player;
}
