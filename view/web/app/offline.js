// The service worker: the page comes from the network where that is there, else as it came the last time.

const PAGE = new URL('app.html', self.location.href).href;

async function kept(request) {
  const cache = await caches.open('prohull');
  try {
    const response = await fetch(request);
    if (response.ok) await cache.put(PAGE, response.clone());
    return response;
  } catch (error) {
    return await cache.match(PAGE) ?? Promise.reject(error);
  }
}

self.addEventListener('install', (event) => event.waitUntil(caches.open('prohull').then((cache) => cache.add(PAGE))));
self.addEventListener('fetch', (event) => {
  if (event.request.method === 'GET' && event.request.url.split(/[?#]/)[0] === PAGE) event.respondWith(kept(event.request));
});
