/** Judges from the answers of STUN and TURN servers whether operators can be reached. */

import { createSocket } from 'node:dgram';
import { hostAddresses, type Interfaces } from '@farpoint/webrtc';
import { fail, ok, type Result, warn } from './finding.ts';
import type { IceAnswer, IceTarget } from './ice-probe.ts';

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

export interface ProbedTarget {
  target: IceTarget;
  answer: IceAnswer;
}

/** @param policy with `relay`, no operator can be reached without TURN */
export function judgeIce(probed: readonly ProbedTarget[], policy: 'all' | 'relay'): Result[] {
  const results = probed.map(judgeOne);
  const relays = probed.filter(({ target }) => isTurn(target));
  const works = relays.some(({ answer }) => answer.outcome === 'answered');
  if (policy === 'relay' && !works)
    results.push(
      fail(
        'network.icePolicy is relay, and no TURN server works',
        'set up a TURN server, or set icePolicy: all',
      ),
    );
  else if (relays.length === 0)
    results.push(
      warn(
        'no TURN server',
        'operators behind strict firewalls and on many mobile links need one: set turnUrls at the signaling service',
      ),
    );
  // The ICE stack uses one server of each kind.
  if (relays.length > 1)
    results.push(
      warn(
        `of ${relays.length} TURN addresses the robot uses the first`,
        'put the best one first; operators’ browsers try all of them',
      ),
    );
  const mapped = probed.flatMap(({ answer }) =>
    answer.outcome === 'answered' && answer.mapped !== null ? [host(answer.mapped)] : [],
  );
  const outside = [...new Set(mapped)];
  if (outside.length > 0)
    results.push(ok(`outbound UDP works; seen from outside as ${outside.join(' and ')}`));
  return results;
}

function judgeOne({ target, answer }: ProbedTarget): Result {
  const { url } = target;
  const kind = isTurn(target) ? 'TURN' : 'STUN';
  switch (answer.outcome) {
    case 'answered':
      return ok(
        answer.relayed === null
          ? `${url} answers in ${answer.milliseconds.toFixed(0)} ms`
          : `${url} allocates ${answer.relayed}, after ${answer.milliseconds.toFixed(0)} ms`,
      );
    case 'silent':
      return fail(`${url} does not answer`, silentRemedy(kind, url));
    case 'unusable':
      return fail(
        `${url}: ${answer.detail}`,
        'write stun:host:port, turn:host:port?transport=udp or turns:host:port',
      );
    case 'refused':
      return fail(`${url} refuses: ${answer.detail}`, refusedRemedy(answer.status));
  }
}

function silentRemedy(kind: string, url: string): string {
  const stream = /transport=tcp/.test(url) || url.startsWith('turns:');
  const remedy = `is the ${kind} server running, and does ${stream ? 'TCP' : 'UDP'} reach it? Check name, port and firewalls`;
  return stream ? `${remedy}, then user name and credential` : remedy;
}

function refusedRemedy(status: number | null): string {
  if (status === 401 || status === 400)
    return 'wrong user name or credential: turnSecret at the signaling service must be the server’s own, and both clocks must be correct';
  if (status === 486) return 'the user’s allocation quota is used up: raise it on the server';
  if (status === 508) return 'the server has no free ports: extend its range';
  return 'check name and port, and the server’s log';
}

const isTurn = ({ url }: IceTarget) => url.startsWith('turn');
const host = (address: string) => address.slice(0, address.lastIndexOf(':'));
