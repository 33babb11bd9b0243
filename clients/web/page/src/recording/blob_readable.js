/** What McapIndexedReader wants from a file: its size, and pieces of it. */
export class BlobReadable {
  constructor(blob) {
    this.blob = blob;
  }

  async size() {
    return BigInt(this.blob.size);
  }

  async read(offset, bytes) {
    const [begin, count] = [Number(offset), Number(bytes)];
    if (begin + count > this.blob.size) throw new Error(`the file ends before byte ${begin + count}`);
    return new Uint8Array(await this.blob.slice(begin, begin + count).arrayBuffer());
  }
}
