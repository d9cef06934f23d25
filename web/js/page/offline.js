// Has the browser keep the site, so that it opens without a network, and says when a newer version is there.

import { SERVICE_WORKER } from "../core/assets.js";
import { notify } from "./toast.js";

// A server on this machine is being worked on: its files change all the time, and it needs no network.
const HERE = ["localhost", "127.0.0.1", "[::1]"];

const READY = "A newer version of Armill is ready.";
const OTHERS = `${READY} Close its other tabs first.`;

/** Registers the service worker once the browser has time for it. The page does not depend on it. */
export function keepOffline() {
  const container = navigator.serviceWorker; // none in an insecure context
  const here = HERE.includes(location.hostname);
  if (!SERVICE_WORKER || !container || here || window !== top) return;
  const idle = window.requestIdleCallback ?? ((act) => setTimeout(act, 1000));
  idle(async () => {
    try {
      watch(await container.register(SERVICE_WORKER, { updateViaCache: "none" }), container);
    } catch {
      // A browser that keeps nothing, or a host without the file: the page works with a network.
    }
  });
}

/**
 * @param {ServiceWorkerRegistration} registration
 * @param {ServiceWorkerContainer} container
 */
function watch(registration, container) {
  const look = () => {
    // Without a controller this is a first visit: what was stored is what is on show.
    if (registration.waiting && container.controller) offer(registration, container);
  };
  const follow = () => registration.installing?.addEventListener("statechange", look);
  registration.addEventListener("updatefound", follow);
  follow();
  look();
}

/**
 * The inputs survive a reload; what is being computed then starts again.
 * @param {ServiceWorkerRegistration} registration
 * @param {ServiceWorkerContainer} container
 */
function offer(registration, container) {
  const reload = { label: "Reload", go: () => registration.waiting?.postMessage("take-over") };
  container.onmessage = ({ data }) => data === "others-open" && notify(OTHERS, reload);
  container.oncontrollerchange = () => location.reload();
  notify(READY, reload);
}
