/** Bundles the page: its worker is a module, and the codec's module stays a file. */
export default {
  base: './',
  worker: { format: 'es' },
  build: { target: 'es2022', assetsInlineLimit: 0 },
};
