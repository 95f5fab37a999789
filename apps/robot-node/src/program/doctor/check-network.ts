/** Checks what this machine offers operators without a server: addresses, and ports to listen on. */
import { createSocket } from 'node:dgram';
import { hostAddresses, type Interfaces } from '@farpoint/webrtc';
import { fail, ok, type Result, warn } from './finding.ts';

/** Names the addresses that operators are offered. */
export function checkAddresses(interfaces: Interfaces): Result[] {
  const offered = hostAddresses(interfaces);
  if (offered.length === 0)
    return [warn('no network but loopback', 'connect this machine: operators elsewhere cannot reach it')];
  return [ok(`candidates ${offered.map(({ name, address }) => `${address} (${name})`).join(', ')}`)];
}

/** Number of ports that one operator's connection may use. */
const PORTS_AN_OPERATOR = 4;

/** @param range `null`: any port */
export async function checkUdpPorts(
  range: readonly [number, number] | null,
  operators: number,
): Promise<Result[]> {
  if (range === null) return [];
  const [low, high] = range;
  const count = high - low + 1;
  const wanted = operators * PORTS_AN_OPERATOR;
  if (count < wanted)
    return [warn(`${count} UDP ports for ${operators} operators`, `give network.udpPorts ${wanted} or more`)];
  const probes = [low, Math.floor((low + high) / 2), high];
  const taken = (await Promise.all(probes.map(async (port) => ((await isFree(port)) ? [] : [port])))).flat();
  const what = `UDP ports ${low}–${high}`;
  if (taken.length === probes.length)
    return [
      fail(
        `${what}: ${taken.join(', ')} cannot be bound`,
        'choose ports above 1023 that no other program uses',
      ),
    ];
  return [ok(`${what} for operators; allow them in this machine’s firewall`)];
}

function isFree(port: number): Promise<boolean> {
  return new Promise((resolve) => {
    const socket = createSocket('udp4');
    socket.on('error', () => {
      socket.close();
      resolve(false);
    });
    socket.bind(port, () => socket.close(() => resolve(true)));
  });
}
