import { Emitter } from "../model/emitter.js";
import { Backoff } from "./backoff.js";
import { SUBPROTOCOL, parseBinary, serviceRequest } from "./protocol.js";

/**
 * A connection to the bridge that comes back by itself. Says:
 * "open", "closed" (will try again), "info" (serverInfo), "channels" and "services" (whenever they change),
 * "message" {channel, timestamp, payload}, "status" {level, message, id}, "removeStatus" {statusIds}.
 */
export class Connection extends Emitter {
  channels = new Map(); // id -> channel as advertised
  services = new Map(); // name -> service as advertised
  info = null;

  #url;
  #makeSocket;
  #socket = null;
  #backoff = new Backoff();
  #subscriptions = new Map(); // subscription id -> channel id
  #calls = new Map(); // call id -> {resolve, reject}
  #nextId = 1;

  constructor(url, makeSocket = (address) => new WebSocket(address, [SUBPROTOCOL])) {
    super();
    this.#url = url;
    this.#makeSocket = makeSocket;
  }

  open() {
    const socket = this.#makeSocket(this.#url);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.#backoff.reset();
      this.emit("open");
    };
    socket.onmessage = ({ data }) => (typeof data === "string" ? this.#takeText(data) : this.#takeBinary(data));
    socket.onclose = () => this.#lost();
    this.#socket = socket;
  }

  get isOpen() {
    return this.#socket?.readyState === 1;
  }

  isSubscribed(channel) {
    return [...this.#subscriptions.values()].includes(channel);
  }

  subscribe(channel) {
    if (this.isSubscribed(channel)) return;
    const id = this.#nextId++;
    this.#subscriptions.set(id, channel);
    this.#send({ op: "subscribe", subscriptions: [{ id, channelId: channel }] });
  }

  unsubscribe(channel) {
    const ids = [...this.#subscriptions].filter(([, subscribed]) => subscribed === channel).map(([id]) => id);
    for (const id of ids) this.#subscriptions.delete(id);
    if (ids.length) this.#send({ op: "unsubscribe", subscriptionIds: ids });
  }

  /** The answer of a service. Rejects with a sentence when there is none. */
  call(name, request) {
    const service = this.services.get(name);
    if (!this.isOpen) return Promise.reject(new Error("The connection is lost."));
    if (!service) return Promise.reject(new Error(`There is no service ${name}.`));
    const id = this.#nextId++;
    this.#socket.send(serviceRequest(service.id, id, request));
    return new Promise((resolve, reject) => this.#calls.set(id, { resolve, reject }));
  }

  #send(message) {
    if (this.isOpen) this.#socket.send(JSON.stringify(message));
  }

  #lost() {
    this.#socket = null;
    this.channels.clear();
    this.services.clear();
    this.#subscriptions.clear();
    for (const { reject } of this.#calls.values()) reject(new Error("The connection is lost."));
    this.#calls.clear();
    this.emit("closed");
    setTimeout(() => this.open(), this.#backoff.next());
  }

  #takeText(text) {
    const message = JSON.parse(text);
    switch (message.op) {
      case "serverInfo":
        this.info = message;
        this.emit("info", message);
        break;
      case "advertise":
        for (const channel of message.channels) this.channels.set(channel.id, channel);
        this.emit("channels");
        break;
      case "unadvertise":
        for (const id of message.channelIds) this.#forget(id);
        this.emit("channels");
        break;
      case "advertiseServices":
        for (const service of message.services) this.services.set(service.name, service);
        this.emit("services");
        break;
      case "unadvertiseServices":
        for (const [name, { id }] of this.services) if (message.serviceIds.includes(id)) this.services.delete(name);
        this.emit("services");
        break;
      case "serviceCallFailure":
        this.#answer(message.callId, ({ reject }) => reject(new Error(message.message)));
        break;
      case "status":
      case "removeStatus":
        this.emit(message.op, message);
        break;
      default: // parameterValues and whatever a later server says
    }
  }

  #takeBinary(buffer) {
    const message = parseBinary(buffer);
    if (message.op === "response") this.#answer(message.call, ({ resolve }) => resolve(message.body));
    if (message.op !== "message") return;
    const channel = this.channels.get(this.#subscriptions.get(message.subscription));
    if (channel) this.emit("message", { channel, timestamp: message.timestamp, payload: message.payload });
  }

  #answer(id, how) {
    const call = this.#calls.get(id);
    this.#calls.delete(id);
    if (call) how(call);
  }

  #forget(channel) {
    this.channels.delete(channel);
    for (const [id, subscribed] of this.#subscriptions) if (subscribed === channel) this.#subscriptions.delete(id);
  }
}
