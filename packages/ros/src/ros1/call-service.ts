/** Calls a service of a ROS 1 graph: asks the master where it is, and then the service itself, in a connection of its own. */
import { Socket } from 'node:net';
import { RosMasterClient } from '@foxglove/ros1';
import { RosFault } from '../fault.ts';
import type { ServiceReply, ServiceType } from '../std-services.ts';
import type { Ros1Options } from './graph.ts';
import { Master } from './master.ts';
import { readServiceReply, SERVICE_SUMS, serviceRequest } from './service-types.ts';
import {
  connectionHeader,
  framed,
  MOST_SERVICE_BYTES,
  readConnectionHeader,
  readServiceAnswer,
} from './service-wire.ts';

export interface ServiceCall {
  /** Its full name. */
  service: string;
  type: ServiceType;
  /** Of std_srvs/SetBool. */
  data: boolean;
}

/**
 * @param within the time that it has, ms
 * @throws {RosFault} `unavailable`: no master, or no such service; `refused` or `wrong-type`: the service does not take the
 *   call; `lost`: it ended the connection, or `within` is over; `bad-message`
 */
export async function callService(
  { masterUrl, name }: Pick<Ros1Options, 'masterUrl' | 'name'>,
  call: ServiceCall,
  within: number,
): Promise<ServiceReply> {
  const caller = name.startsWith('/') ? name : `/${name}`;
  const { hostname, port } = await addressOf(masterUrl, caller, call.service);
  const socket = new Socket();
  try {
    return await exchange(socket, { hostname, port, caller }, call, within);
  } finally {
    socket.destroy();
  }
}

async function addressOf(
  masterUrl: string,
  caller: string,
  service: string,
): Promise<{ hostname: string; port: number }> {
  try {
    const { protocol, hostname, port } = new URL(
      await new Master(new RosMasterClient(masterUrl), caller, '').serviceUrl(service),
    );
    if (protocol !== 'rosrpc:' || hostname === '' || port === '')
      throw new Error('the master names no address');
    return { hostname, port: Number(port) };
  } catch (error) {
    const detail = error instanceof Error ? error.message : String(error);
    throw new RosFault('unavailable', detail, { topic: service, cause: error });
  }
}

function exchange(
  socket: Socket,
  { hostname, port, caller }: { hostname: string; port: number; caller: string },
  { service, type, data }: ServiceCall,
  within: number,
): Promise<ServiceReply> {
  const md5sum = SERVICE_SUMS[type];
  let received = new Uint8Array();
  let isAsked = false;
  /** @returns `null` while the answer is not complete @throws {RosFault} */
  const take = (): ServiceReply | null => {
    if (!isAsked) {
      const header = readConnectionHeader(received);
      if (header === null) return null;
      const refusal = header.fields.get('error');
      if (refusal !== undefined) throw new RosFault('refused', refusal);
      const theirs = header.fields.get('md5sum');
      if (theirs !== undefined && theirs !== md5sum && theirs !== '*')
        throw new RosFault('wrong-type', `it is no ${type}`);
      isAsked = true;
      received = received.slice(header.length);
      socket.write(framed(serviceRequest(type, data)));
    }
    const answer = readServiceAnswer(received);
    if (answer === null) return null;
    if (!answer.ok) throw new RosFault('refused', new TextDecoder().decode(answer.payload));
    return readServiceReply(type, answer.payload);
  };
  return new Promise((resolve, reject) => {
    const fail = (error: unknown) => reject(RosFault.of(error, service));
    const timer = setTimeout(() => fail(new RosFault('lost', `no answer within ${within / 1000} s`)), within);
    socket.once('error', ({ message }) => fail(new RosFault('lost', message)));
    socket.once('close', () => {
      clearTimeout(timer);
      fail(new RosFault('lost', 'it ended the connection'));
    });
    socket.on('data', (chunk) => {
      try {
        if (received.length + chunk.length > 2 * MOST_SERVICE_BYTES)
          throw new RosFault('too-large', 'it sends more than an answer');
        received = joined(received, chunk);
        const reply = take();
        if (reply !== null) resolve(reply);
      } catch (error) {
        fail(error);
      }
    });
    socket.connect(port, hostname, () => {
      socket.setNoDelay(true);
      socket.write(connectionHeader({ callerid: caller, md5sum, persistent: '0', service, type }));
    });
  });
}

function joined(first: Uint8Array, second: Uint8Array): Uint8Array<ArrayBuffer> {
  const both = new Uint8Array(first.length + second.length);
  both.set(first);
  both.set(second, first.length);
  return both;
}
