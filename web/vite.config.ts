import { defineConfig } from 'vite';

// For `npm run dev`: the page by Vite, its data by a running `faceprobe serve`, which answers its own origin alone.
const server = process.env['FACEPROBE_URL'] ?? 'http://127.0.0.1:8765';

export default defineConfig({
  build: {
    target: 'es2021',
    // The page's policy allows no data: addresses for scripts and styles, and small files cost nothing on the loopback.
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900,
    rollupOptions: {
      output: {
        // One chunk that is fetched when the first estimate is shown, and not for the first paint.
        manualChunks: (id) => (id.includes('/node_modules/three/') ? 'three' : undefined),
      },
    },
  },
  server: {
    proxy: { '/api': { target: server, changeOrigin: true, headers: { origin: server } } },
  },
});
