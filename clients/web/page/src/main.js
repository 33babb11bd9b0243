import { App } from "./app.js";

// For tests and for the curious: window.flexcast.timings.medians() says what a frame costs.
window.flexcast = new App();
