/**
 * The service worker: without a connection, it shows a page that says so. It keeps nothing else, so that no operator
 * ever drives with an older page than the server's.
 */

/** What of a service worker's scope is used; TypeScript has it for workers only, and this page is checked as one. */
interface WorkerScope {
  addEventListener(type: 'install' | 'activate', listener: (event: WorkerEvent) => void): void;
  addEventListener(type: 'fetch', listener: (event: RequestEvent) => void): void;
  skipWaiting(): Promise<void>;
  readonly clients: { claim(): Promise<void> };
}
interface WorkerEvent {
  waitUntil(work: Promise<unknown>): void;
}
interface RequestEvent {
  readonly request: Request;
  respondWith(response: Promise<Response>): void;
}

const scope = globalThis as unknown as WorkerScope;
const CACHE = 'offline';
const PAGE = './offline.html';

scope.addEventListener('install', (event) => {
  const keep = async () => {
    const cache = await caches.open(CACHE);
    await cache.add(new Request(PAGE, { cache: 'reload' }));
    await scope.skipWaiting();
  };
  event.waitUntil(keep());
});

scope.addEventListener('activate', (event) => event.waitUntil(scope.clients.claim()));

scope.addEventListener('fetch', (event) => {
  if (event.request.mode !== 'navigate') return;
  const offline = async (error: unknown): Promise<Response> => {
    const page = await caches.match(PAGE);
    if (page === undefined) throw error;
    return page;
  };
  event.respondWith(fetch(event.request).catch(offline));
});
