// Writes the files of a folder as a C++ source with the table of clients/web/assets.h, compressed.
//
//   node embed.js dist page_assets.cpp
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { extname, join } from "node:path";
import { constants, gzipSync } from "node:zlib";

const TYPES = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".svg": "image/svg+xml",
};

function filesIn(folder, below = "") {
  return readdirSync(join(folder, below), { withFileTypes: true }).flatMap((entry) => {
    const path = `${below}/${entry.name}`;
    return entry.isDirectory() ? filesIn(folder, path) : [path];
  });
}

function assetOf(folder, file, number) {
  const type = TYPES[extname(file)];
  if (!type) throw new Error(`embed: no content type is known for ${file}`);
  // Level 9 and no time in the header: the same files give the same bytes.
  const content = gzipSync(readFileSync(join(folder, file)), { level: constants.Z_BEST_COMPRESSION });
  return {
    array: `const unsigned char content_${number}[] = {${Array.from(content).join(",")}};`,
    row: `    {"${file === "/index.html" ? "/" : file}", "${type}", content_${number}, true},`,
  };
}

const [folder, target] = process.argv.slice(2);
const assets = filesIn(folder).map((file, number) => assetOf(folder, file, number));
writeFileSync(
  target,
  `// Made by embed.js from the page's files.
#include "clients/web/assets.h"

namespace flexcast::web {
namespace {

${assets.map(({ array }) => array).join("\n")}

const Asset table[] = {
${assets.map(({ row }) => row).join("\n")}
};

}  // namespace

std::span<const Asset> assets() { return table; }

}  // namespace flexcast::web
`,
);
