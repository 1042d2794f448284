// Runs sw.js of two publications against a small browser of maps: node worker_test.js OLD NEW WITHDRAWN KEPT
"use strict";

const assert = require("node:assert");
const { webcrypto } = require("node:crypto");
const fs = require("node:fs");
const path = require("node:path");
const vm = require("node:vm");

const [older, newer, withdrawn, kept] = process.argv.slice(2);
const SCOPE = "http://127.0.0.1/a%20b/";
const world = { folder: older, online: true, days: 0, asked: [] };

class Cache {
  constructor() { this.files = new Map(); }
  key(it) { return typeof it === "string" ? it : it.url; }
  async match(it) { const found = this.files.get(this.key(it)); return found && found.clone(); }
  async put(it, answer) { this.files.set(this.key(it), answer); }
  async delete(it) { return this.files.delete(this.key(it)); }
  async keys() { return [...this.files.keys()].map((url) => ({ url })); }
}

const stores = new Map();
const caches = {
  open: async (name) => { if (!stores.has(name)) stores.set(name, new Cache()); return stores.get(name); },
  has: async (name) => stores.has(name),
  keys: async () => [...stores.keys()],
  delete: async (name) => stores.delete(name),
};

async function fetch(request, how) {
  const address = typeof request === "string" ? request : request.url;
  assert(["no-cache", "no-store"].includes(how.cache), "a browser's own copy could hold what was withdrawn: " + address);
  world.asked.push(address);
  if (!world.online) throw new TypeError("no connection");
  assert(address.startsWith(SCOPE), address);
  let file = path.join(world.folder, decodeURIComponent(new URL(address).pathname.slice("/a%20b/".length)));
  if (file.endsWith(path.sep) || address === SCOPE) file = path.join(file, "index.html");
  if (world.folder === null || !fs.existsSync(file)) return new Response("not here", { status: 404 });
  return new Response(fs.readFileSync(file), { headers: { "Content-Type": "text/plain" } });
}

function worker(folder) {
  const heard = {};
  const self = {
    registration: { scope: SCOPE, unregister: async () => { world.unregistered = true; }, update: async () => {} },
    addEventListener: (name, run) => { heard[name] = run; }, skipWaiting: async () => {}, clients: { claim: async () => {} },
  };
  const clock = { now: () => Date.now() + world.days * 86400000 };
  vm.runInNewContext(fs.readFileSync(path.join(folder, "sw.js"), "utf8"),
    { self, caches, fetch, Response, URL, AbortSignal, Date: clock, crypto: webcrypto, Uint8Array, Promise });
  const run = async (name, more) => { let done; heard[name]({ waitUntil: (it) => { done = it; }, ...more }); await done; };
  return {
    install: () => run("install"), activate: () => run("activate"),
    async wish(wish, names) { let said = null; await run("message", { data: { wish, names }, source: { postMessage: (it) => { said = it; } } }); return said; },
    async open(name, mode = "navigate") {
      let answer = null;
      const url = SCOPE + name.split("/").map(encodeURIComponent).join("/");
      heard.fetch({ request: { url, method: "GET", mode }, respondWith: (it) => { answer = it; } });
      return answer;
    },
  };
}

// The names of the caches and everything in them.
async function everything() {
  const texts = [];
  for (const [name, cache] of stores) {
    texts.push(name);
    for (const [key, answer] of cache.files) texts.push(decodeURIComponent(key), await answer.clone().text());
  }
  return texts.join("\n");
}

const page = (gloss) => "sign/" + gloss + "/index.html";

(async () => {
  const first = worker(older);
  await first.install();
  await first.activate();
  assert.equal(stores.size, 1);
  const part = await first.wish("state");
  assert(part.kept > 5 && part.kept < part.files, JSON.stringify(part));
  assert((await (await first.open(page(withdrawn))).text()).includes(withdrawn));
  world.online = false;
  assert.equal((await first.open("index.html")).status, 200, "the search works without a connection");
  assert((await (await first.open("")).text()).includes("<main"), "the folder is its index.html");
  assert.equal((await first.open("data/signs.js", "no-cors")).status, 200);
  assert((await (await first.open(page(withdrawn))).text()).includes(withdrawn), "so does a sign that was opened");
  assert.equal((await first.open(page(kept))).status, 503, "a sign that nobody opened is not in the copy");
  world.online = true;
  const all = await first.wish("all");
  assert.equal(all.kept, all.files);
  world.online = false;
  assert.equal((await first.open(page(kept))).status, 200, "all signs are in the copy");
  world.online = true;
  assert((await everything()).includes(withdrawn));

  // A sign is withdrawn. The first page that is opened with a connection is the new one, and the copy forgets the sign
  // before the new script is even there.
  world.folder = newer;
  assert.equal((await first.open(page(withdrawn))).status, 404);
  assert(!(await everything()).includes(withdrawn), "the copy has no trace of the sign");
  assert((await everything()).includes(kept), "the other signs stay");
  assert(!(await (await first.open("data/signs.js", "no-cors")).text()).includes(withdrawn));
  const second = worker(newer);
  world.asked = [];
  await second.install();
  assert(!world.asked.some((it) => it.endsWith("app.js") || it.includes("hands/")), "what did not change is not loaded again");
  await second.activate();
  assert.equal(stores.size, 1);
  assert(!(await everything()).includes(withdrawn));
  world.online = false;
  assert.equal((await second.open(page(kept))).status, 200);
  assert.equal((await second.open(page(withdrawn))).status, 503);
  assert(!(await (await second.open("data/signs.js", "no-cors")).text()).includes(withdrawn));

  // Without a connection a copy is not shown for ever.
  world.days = 29;
  assert.equal((await second.open("index.html")).status, 200);
  world.days = 31;
  assert.equal((await second.open("index.html")).status, 503);
  assert.equal(stores.size, 0, "the copy is deleted");
  world.days = 0;

  // A copy that was deleted by hand can begin again.
  world.online = true;
  await second.wish("all");
  assert.equal(stores.size, 1);
  // A page that is no dictionary answers, as in the net of a hotel: nothing is shown from the copy, nothing deleted.
  const foreign = fs.mkdtempSync(path.join(path.dirname(newer), "foreign"));
  for (const name of ["version.txt", "index.html"]) fs.writeFileSync(path.join(foreign, name), "<p>sign in</p>");
  world.folder = foreign;
  assert.equal(await (await second.open("index.html")).text(), "<p>sign in</p>");
  assert.equal(stores.size, 1);
  // A file of another publication does not get into the copy.
  world.folder = older;
  await second.wish("forget");
  await assert.rejects(worker(newer).install());
  assert(!(await everything()).includes(withdrawn));
  // The dictionary is gone: so is the copy.
  world.folder = newer;
  await second.wish("all");
  world.folder = path.join(foreign, "nothing");
  assert.equal((await second.open("index.html")).status, 404);
  assert.equal(stores.size, 0);
  assert(world.unregistered);
  console.log("ok");
})().catch((error) => { console.error(error); process.exit(1); });
