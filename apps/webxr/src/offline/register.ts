/** Has the browser show a page of ours when it cannot reach the server. Without one, it shows its own. */
export function registerOfflineWorker(): void {
  // Only where the page came by HTTPS, or from this machine.
  const { serviceWorker } = navigator as { serviceWorker?: ServiceWorkerContainer };
  serviceWorker?.register(new URL('offline-worker.js', document.baseURI)).catch((error: unknown) => {
    console.warn('without a page for lost connections:', error);
  });
}
