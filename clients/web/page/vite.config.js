import { defineConfig } from "vite";

const bridge = `http://${process.env.FLEXCAST_WEB ?? "127.0.0.1:8080"}`;

// The bridge serves the page and its WebSocket in one port; while developing, vite serves the page and hands the
// WebSocket on to a running bridge: FLEXCAST_WEB=127.0.0.1:8080 npx vite
export default defineConfig({
  build: {
    target: "es2022",
    assetsInlineLimit: 0, // the page's policy allows no data: addresses
    chunkSizeWarningLimit: 1500,
    modulePreload: { polyfill: false },
  },
  server: {
    host: "127.0.0.1",
    proxy: {
      "^/$": {
        target: bridge,
        ws: true,
        changeOrigin: true,
        headers: { origin: bridge }, // it takes pages of its own address only
        bypass: (request) => (request.headers.upgrade ? undefined : request.url),
      },
    },
  },
});
