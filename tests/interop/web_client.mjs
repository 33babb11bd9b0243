// WebClient: a client of flexcast-web made of others' code: @foxglove/ws-protocol speaks, @foxglove/omgidl-serialization
// decodes.
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";
import protocol from "@foxglove/ws-protocol";
import WebSocket from "ws";

const { FoxgloveClient } = protocol;
const PATIENCE = 30_000; // ms, for anything

export class WebClient {
  info = null;
  channels = new Map(); // by topic
  services = new Map(); // by name
  statuses = [];
  protocol = "";

  #client;
  #socket;
  #readers = new Map(); // by subscription
  #waiting = new Set(); // functions that are called after every message
  #messages = new Map(); // topic to its messages
  #topics = new Map(); // by subscription
  #responses = new Map();
  #parameters = [];
  #call = 0;

  constructor(url, name) {
    this.#socket = new WebSocket(url, [name]);
    // The library knows its own protocol's first name only; the messages are the same.
    const socket = new Proxy(this.#socket, {
      get: (target, key) => {
        if (key === "protocol") return FoxgloveClient.SUPPORTED_SUBPROTOCOL;
        const value = target[key];
        return typeof value === "function" ? value.bind(target) : value;
      },
      set: (target, key, value) => Reflect.set(target, key, value),
    });
    this.#client = new FoxgloveClient({ ws: socket });
    this.#listen();
  }

  // Waits until `find` gives something.
  wait(what, find) {
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`there is no ${what} after ${PATIENCE} ms`)), PATIENCE);
      const look = () => {
        const found = find();
        if (found === undefined || found === null || found === false) return;
        clearTimeout(timer);
        this.#waiting.delete(look);
        resolve(found);
      };
      this.#waiting.add(look);
      look();
    });
  }

  async subscribe(topic) {
    const channel = await this.wait(`channel ${topic}`, () => this.channels.get(topic));
    if (channel.encoding !== "cdr" || channel.schemaEncoding !== "omgidl") throw new Error(`${topic}: another encoding`);
    const subscription = this.#client.subscribe(channel.id);
    this.#readers.set(subscription, new MessageReader(channel.schemaName, parseIDL(channel.schema)));
    this.#topics.set(subscription, topic);
    return subscription;
  }

  unsubscribe(subscription) {
    this.#client.unsubscribe(subscription);
  }

  // The newest message of a topic for which `wanted` holds.
  message(topic, wanted = () => true) {
    return this.wait(`message of ${topic}`, () => {
      const message = this.messages(topic).at(-1);
      return message && wanted(message.value) ? message : null;
    });
  }

  messages(topic) {
    return this.#messages.get(topic) ?? [];
  }

  async call(name, request = {}) {
    const service = await this.wait(`service ${name}`, () => this.services.get(name));
    const callId = ++this.#call;
    const data = new TextEncoder().encode(JSON.stringify(request));
    this.#client.sendServiceCallRequest({ serviceId: service.id, callId, encoding: "json", data: new DataView(data.buffer) });
    return await this.wait(`answer to ${name}`, () => this.#responses.get(callId));
  }

  async setParameters(parameters, id) {
    this.#client.setParameters(parameters, id);
    return await this.#answer(id);
  }

  async getParameters(names, id) {
    this.#client.getParameters(names, id);
    return await this.#answer(id);
  }

  watchParameters(names) {
    this.#client.subscribeParameterUpdates(names);
  }

  // The newest parameterValues message without an id that tells of this parameter.
  update(name) {
    return this.wait(`update of ${name}`, () =>
      this.#parameters
        .filter((message) => message.id === undefined)
        .flatMap((message) => message.parameters)
        .findLast((parameter) => parameter.name === name),
    );
  }

  close() {
    this.#client.close();
  }

  async #answer(id) {
    const message = await this.wait(`answer ${id}`, () => this.#parameters.find((values) => values.id === id));
    return Object.fromEntries(message.parameters.map(({ name, value }) => [name, value]));
  }

  #listen() {
    const on = (event, receive) =>
      this.#client.on(event, (content) => {
        receive(content);
        for (const look of [...this.#waiting]) look();
      });
    on("error", (error) => {
      // What the library does not know is no error: removeStatus, serviceCallFailure.
      if (!/Unrecognized server opcode/.test(String(error?.message))) throw error;
    });
    on("open", () => {
      this.protocol = this.#socket.protocol;
    });
    on("serverInfo", (info) => {
      this.info = info;
    });
    on("advertise", (channels) => {
      for (const channel of channels) this.channels.set(channel.topic, channel);
    });
    on("unadvertise", (ids) => {
      for (const [topic, channel] of this.channels) if (ids.includes(channel.id)) this.channels.delete(topic);
    });
    on("advertiseServices", (services) => {
      for (const service of services) this.services.set(service.name, service);
    });
    on("status", (status) => this.statuses.push(status));
    on("parameterValues", (values) => this.#parameters.push(values));
    on("serviceCallResponse", (response) => {
      const bytes = new Uint8Array(response.data.buffer, response.data.byteOffset, response.data.byteLength);
      this.#responses.set(response.callId, JSON.parse(new TextDecoder().decode(bytes)));
    });
    on("message", ({ subscriptionId, timestamp, data }) => {
      const topic = this.#topics.get(subscriptionId);
      const value = this.#readers.get(subscriptionId).readMessage(data);
      this.#messages.set(topic, [...this.messages(topic), { timestamp, value }]);
    });
    this.#socket.on("message", (content, isBinary) => {
      if (isBinary) return;
      const message = JSON.parse(content.toString());
      if (message.op === "serviceCallFailure") this.#responses.set(message.callId, { failure: message.message });
      for (const look of [...this.#waiting]) look();
    });
  }
}
