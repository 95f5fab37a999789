/** A TURN server (RFC 8656) that says whatever a test wants. */

import { createSocket, type Socket } from 'node:dgram';
import { once } from 'node:events';
import type { AddressInfo } from 'node:net';
import { Waiters } from '@farpoint/service/testing/waiters';

export const TURN = { allocate: 0x003, refresh: 0x004, permission: 0x008, channelBind: 0x009 } as const;
const [SUCCESS, ERROR] = [0x100, 0x110];
const BINDING = 0x001;
const COOKIE = 0x2112_a442;

export type Attribute = readonly [type: number, value: Buffer];

export const lifetime = (seconds: number): Attribute => {
  const value = Buffer.alloc(4);
  value.writeUInt32BE(seconds);
  return [0x000d, value];
};

/** XOR-RELAYED-ADDRESS and XOR-MAPPED-ADDRESS of 127.0.0.1. */
export const addresses = (port: number): Attribute[] => {
  const value = Buffer.alloc(8);
  value[1] = 1;
  value.writeUInt16BE(port ^ (COOKIE >>> 16), 2);
  value.writeUInt32BE((0x7f00_0001 ^ COOKIE) >>> 0, 4);
  return [
    [0x0016, value],
    [0x0020, value],
  ];
};

function response(request: Buffer, kind: number, attributes: readonly Attribute[]): Buffer {
  const body = attributes.map(([type, value]) => {
    const head = Buffer.alloc(4);
    head.writeUInt16BE(type);
    head.writeUInt16BE(value.length, 2);
    return Buffer.concat([head, value, Buffer.alloc((4 - (value.length % 4)) % 4)]);
  });
  const payload = Buffer.concat(body);
  const header = Buffer.from(request.subarray(0, 20));
  header.writeUInt16BE(request.readUInt16BE(0) | kind);
  header.writeUInt16BE(payload.length, 2);
  return Buffer.concat([header, payload]);
}

export const success = (request: Buffer, ...attributes: readonly Attribute[]) =>
  response(request, SUCCESS, attributes);
export const error = (request: Buffer, ...attributes: readonly Attribute[]) =>
  response(request, ERROR, attributes);

export class HostileTurn {
  readonly port: number;
  readonly #socket: Socket;
  readonly #requests: number[] = [];
  readonly #waiters = new Waiters();

  private constructor(socket: Socket, answer: (request: Buffer, method: number) => readonly Buffer[]) {
    this.#socket = socket;
    this.port = (socket.address() as AddressInfo).port;
    socket.on('message', (request, { port, address }) => {
      if (request.length < 20) return;
      const method = request.readUInt16BE(0);
      this.#requests.push(method);
      for (const datagram of answer(request, method)) socket.send(datagram, port, address);
      this.#waiters.changed();
    });
  }

  /** @param answer what is sent back to a request */
  static async open(answer: (request: Buffer, method: number) => readonly Buffer[]): Promise<HostileTurn> {
    const socket = createSocket('udp4').bind(0, '127.0.0.1');
    await once(socket, 'listening');
    return new HostileTurn(socket, answer);
  }

  count(method: number): number {
    return this.#requests.filter((each) => each === method).length;
  }

  /** Resolves once this many requests of the method have arrived. */
  asked(method: number, times = 1): Promise<void> {
    return this.#waiters.until(() => this.count(method) >= times);
  }

  /** A request of somebody else, and its answer. */
  async roundTrip(): Promise<void> {
    const socket = createSocket('udp4');
    const request = Buffer.alloc(20);
    request.writeUInt16BE(BINDING);
    request.writeUInt32BE(COOKIE, 4);
    socket.send(request, this.port, '127.0.0.1');
    await once(socket, 'message');
    socket.close();
  }

  close(): void {
    this.#socket.close();
  }
}
