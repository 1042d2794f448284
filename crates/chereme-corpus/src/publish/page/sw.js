// The copy of the dictionary on a device, for use without a connection. It holds only files of this publication: each
// is named with its hash in offline.txt, and the hash of that list is the version. As long as there is a connection,
// every page asks first whether the version still holds; if it does not, nothing of the copy is shown any more, and
// what the new publication does not have is deleted at once, before anything else is loaded.
"use strict";

const VERSION = "@@VERSION@@";
// For so many days without a connection the copy is shown.
const DAYS = @@DAYS@@;
const TEXTS = @@TEXTS@@;
const SCOPE = self.registration.scope;
const FAMILY = "chereme " + SCOPE + " ";
const OWN = FAMILY + VERSION;
const LIST = "offline.txt";
const STAMP = "checked";

const addressOf = (name) => SCOPE + name.split("/").map(encodeURIComponent).join("/");

// The name of a file in the publication; nothing for other addresses.
function nameOf(address) {
  const url = new URL(address);
  const plain = url.origin + url.pathname;
  if (!plain.startsWith(SCOPE)) return null;
  try {
    const name = decodeURIComponent(plain.slice(SCOPE.length));
    return (name === "" || name.endsWith("/") ? name + "index.html" : name).normalize("NFC");
  } catch {
    return null;
  }
}

// A line of the list has the hash of a file, its size and its name.
function readList(text) {
  const list = new Map();
  for (const line of text.split("\n")) {
    const [, hash, size, name] = /^([0-9a-f]{16}) (\d+) (.+)$/.exec(line) || [];
    if (name) list.set(name, { hash, size: Number(size) });
  }
  return list;
}

const writeList = (list) => [...list].map(([name, it]) => it.hash + " " + it.size + " " + name + "\n").join("");

async function listOf(cache) {
  const kept = await cache.match(addressOf(LIST));
  return readList(kept ? await kept.text() : "");
}

async function digest(bytes) {
  const whole = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  return Array.from(whole.subarray(0, 8), (it) => it.toString(16).padStart(2, "0")).join("");
}

// Loads a file, which must be that of the list.
async function loaded(name, hash) {
  const answer = await fetch(addressOf(name), { cache: "no-cache" });
  const bytes = answer.ok ? await answer.arrayBuffer() : null;
  if (!bytes || (await digest(bytes)) !== hash) throw new Error(name + " is not the file of this version");
  return new Response(bytes, { headers: { "Content-Type": answer.headers.get("Content-Type") || "application/octet-stream" } });
}

// Runs some work for each item, a few at a time.
async function each(items, work) {
  const waiting = items[Symbol.iterator]();
  const one = async () => { for (const item of waiting) await work(item); };
  await Promise.all(Array.from({ length: 6 }, one));
}

const family = async () => (await caches.keys()).filter((it) => it.startsWith(FAMILY));
const own = async () => ((await caches.has(OWN)) ? caches.open(OWN) : null);
const stamp = (cache) => cache.put(addressOf(STAMP), new Response(String(Date.now())));
const forget = async () => Promise.all((await family()).map((it) => caches.delete(it)));

// The search is always part of a copy; signs are if somebody visited them or asked for all.
const isSearch = (name) => !/^(sign\/|data\/motion\/|list\.html$)/.test(name);

async function install() {
  const text = await (await loaded(LIST, VERSION)).text();
  const list = readList(text);
  const cache = await caches.open(OWN);
  await cache.put(addressOf(LIST), new Response(text));
  // Files that did not change move over from an older copy.
  for (const key of await family()) {
    if (key === OWN) continue;
    const old = await caches.open(key);
    const known = await listOf(old);
    await each(await old.keys(), async (request) => {
      const name = nameOf(request.url);
      const same = list.has(name) && known.has(name) && list.get(name).hash === known.get(name).hash;
      const file = same && (await old.match(request));
      if (file) await cache.put(addressOf(name), file);
    });
  }
  await fill(cache, list, [...list.keys()].filter(isSearch));
  await stamp(cache);
}

// Loads the files that a copy does not have yet.
async function fill(cache, list, names, done) {
  await each(names, async (name) => {
    if (!(await cache.match(addressOf(name)))) await cache.put(addressOf(name), await loaded(name, list.get(name).hash));
    if (done) done();
  });
}

// Deletes what the newest publication does not have, or has with other content; everything, if that cannot be known.
async function prune() {
  let list = new Map();
  try {
    const answer = await fetch(addressOf(LIST), { cache: "no-cache" });
    if (answer.ok) list = readList(await answer.text());
  } catch { /* Then nothing may stay. */ }
  for (const key of await family()) {
    const cache = await caches.open(key);
    const known = await listOf(cache);
    for (const [name, it] of known) if (!list.has(name) || list.get(name).hash !== it.hash) known.delete(name);
    for (const request of await cache.keys()) if (!known.has(nameOf(request.url))) await cache.delete(request);
    await cache.put(addressOf(LIST), new Response(writeList(known)));
  }
}

// Asks the server whether this version still holds: "same", "other", "gone", "foreign" if something else answers (such as
// the page of a hotspot), "offline", or "old" if there is no connection and the copy may no longer be shown.
async function ask() {
  let answer;
  try {
    answer = await fetch(addressOf("version.txt"), { cache: "no-store", signal: AbortSignal.timeout(3000) });
    if (answer.status === 404 || answer.status === 410) {
      await forget();
      await self.registration.unregister();
      return "gone";
    }
    if (!answer.ok) throw new Error("the server is in trouble");
  } catch {
    const cache = await own();
    const last = cache && (await cache.match(addressOf(STAMP)));
    const days = last ? (Date.now() - Number(await last.text())) / 86400000 : Infinity;
    if (days >= 0 && days <= DAYS) return "offline";
    await forget();
    return "old";
  }
  const version = (await answer.text()).trim();
  if (version === VERSION) {
    const cache = await own();
    if (cache) await stamp(cache);
    return "same";
  }
  if (!/^[0-9a-f]{16}$/.test(version)) return "foreign";
  await prune();
  self.registration.update().catch(() => {});
  return "other";
}

let asked = { at: 0, answer: null };

// Pages ask each time; what belongs to a page takes its answer.
function state(isPage) {
  if (isPage || Date.now() - asked.at > 10000) asked = { at: Date.now(), answer: ask() };
  return asked.answer;
}

async function answer(request, name) {
  const isPage = request.mode === "navigate";
  const now = await state(isPage);
  const cache = now === "same" || now === "offline" ? await own() : null;
  const kept = cache && (await cache.match(addressOf(name)));
  if (kept) return kept;
  const it = now === "same" && cache && (await listOf(cache)).get(name);
  if (it) {
    try {
      const file = await loaded(name, it.hash);
      await cache.put(addressOf(name), file.clone());
      return file;
    } catch { /* The server is asked as if there was no copy. */ }
  }
  try {
    // A browser may have kept a file of its own accord, with all that was withdrawn since.
    return await fetch(request, { cache: "no-cache" });
  } catch {
    return isPage ? notice(now === "offline") : Response.error();
  }
}

function notice(hasCopy) {
  const says = hasCopy ? TEXTS.missing + "<p><a href=\"" + SCOPE + "index.html\">" + TEXTS.search + "</a></p>" : TEXTS.old;
  const page = "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>" + TEXTS.name + "</title>"
    + "<main><h1>" + TEXTS.title + "</h1>" + says + "</main></html>";
  return new Response(page, { status: 503, headers: { "Content-Type": "text/html; charset=utf-8" } });
}

async function report(client, more) {
  const cache = await own();
  const list = cache ? await listOf(cache) : new Map();
  const names = cache ? (await cache.keys()).map((it) => nameOf(it.url)).filter((it) => list.has(it)) : [];
  const bytes = [...list.values()].reduce((sum, it) => sum + it.size, 0);
  client.postMessage({ files: list.size, kept: names.length, bytes, ...more });
}

// A page asks for the state of the copy, for all signs, for the files that it shows, or for an end of the copy.
async function hear(event) {
  const client = event.source;
  const { wish, names } = event.data;
  if (wish === "forget") {
    await forget();
    await self.registration.unregister();
    client.postMessage({ forgotten: true });
    return;
  }
  if (wish !== "state" && (await state(wish === "all")) === "same") {
    // A copy that was deleted begins again.
    if (!(await own())) await install();
    const cache = await caches.open(OWN);
    const list = await listOf(cache);
    const wanted = wish === "all" ? [...list.keys()] : names.map(nameOf).filter((it) => list.has(it));
    let done = 0;
    const show = () => {
      done += 1;
      if (wish === "all" && done % 50 === 0) client.postMessage({ files: list.size, kept: done, busy: true });
    };
    try {
      await fill(cache, list, wanted, show);
    } catch {
      return report(client, { failed: wish === "all" });
    }
  }
  return report(client);
}

self.addEventListener("install", (event) => event.waitUntil(install().then(() => self.skipWaiting())));
self.addEventListener("activate", (event) => event.waitUntil((async () => {
  for (const key of await family()) if (key !== OWN) await caches.delete(key);
  await self.clients.claim();
})()));
self.addEventListener("message", (event) => event.waitUntil(hear(event)));
self.addEventListener("fetch", (event) => {
  const name = event.request.method === "GET" ? nameOf(event.request.url) : null;
  if (name !== null && name !== "sw.js" && name !== "version.txt") event.respondWith(answer(event.request, name));
});
