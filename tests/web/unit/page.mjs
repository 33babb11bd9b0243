// The modules of the page, from where they were built: there their packages are.
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const source = fileURLToPath(new URL("../../../clients/web/page", import.meta.url));
const folder = process.env.FLEXCAST_PAGE ?? source;

/** page("decode/particles.js") */
export const page = (module) => import(pathToFileURL(join(folder, "src", module)));
