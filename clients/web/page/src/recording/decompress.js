import { decompress as decompressZstd } from "fzstd";
import lz4 from "lz4js";

/** How chunks of a recording are unpacked, by the name of their compression. */
export const decompressHandlers = {
  lz4: (packed, bytes) => lz4.decompress(packed, Number(bytes)),
  zstd: (packed, bytes) => decompressZstd(packed, new Uint8Array(Number(bytes))),
};
