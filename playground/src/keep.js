/* Keeps the playground for use without a network: every file of one build, those of LATE once they
 * have been asked for, and no other request. */
const NAME = "derive-play-__VERSION__";
const FILES = __FILES__, LATE = __LATE__;

addEventListener("install", (e) => e.waitUntil((async () => {
  const cache = await caches.open(NAME);
  await cache.addAll(FILES);
  await skipWaiting();
})()));

addEventListener("activate", (e) => e.waitUntil((async () => {
  const old = (await caches.keys()).filter((x) => x.startsWith("derive-play-") && x !== NAME);
  await Promise.all(old.map((x) => caches.delete(x)));
  await clients.claim();
})()));

addEventListener("fetch", (e) => {
  const url = new URL(e.request.url);
  if (e.request.method !== "GET" || url.origin !== location.origin) return;
  const place = new URL("./", location.href).pathname;
  if (!url.pathname.startsWith(place)) return;
  const name = url.pathname.slice(place.length);
  const key = name === "" || name === "index.html" ? "./" : name;
  if (![...FILES, ...LATE].includes(key)) return;
  e.respondWith((async () => {
    const cache = await caches.open(NAME), stored = await cache.match(key);
    if (stored) return stored;
    const found = await fetch(e.request);
    if (found.ok && LATE.includes(key)) e.waitUntil(cache.put(key, found.clone()));
    return found;
  })());
});
