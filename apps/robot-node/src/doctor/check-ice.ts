/** What the answers of STUN and TURN servers mean for reaching operators. */
import { fail, ok, type Result, warn } from './finding.ts';
import type { IceAnswer, IceTarget } from './ice-probe.ts';

export interface ProbedTarget {
  target: IceTarget;
  answer: IceAnswer;
}

/** @param policy `relay`: without TURN nobody is reached */
export function judgeIce(probed: readonly ProbedTarget[], policy: 'all' | 'relay'): Result[] {
  const results = probed.map(judgeOne);
  const relays = probed.filter(({ target }) => isTurn(target));
  const works = relays.some(({ answer }) => answer.outcome === 'answered');
  if (policy === 'relay' && !works)
    results.push(
      fail('network.icePolicy is relay, and no TURN server works', 'set one up, or icePolicy: all'),
    );
  else if (relays.length === 0)
    results.push(
      warn(
        'no TURN server',
        'operators behind strict firewalls and on many mobile links need one: set turnUrls at the signaling service',
      ),
    );
  // The stack takes one of each kind.
  if (relays.length > 1)
    results.push(
      warn(
        `of ${relays.length} TURN addresses the robot uses the first`,
        'put the best one first; operators’ browsers try all',
      ),
    );
  const mapped = probed.flatMap(({ answer }) =>
    answer.outcome === 'answered' && answer.mapped !== null ? [host(answer.mapped)] : [],
  );
  const outside = [...new Set(mapped)];
  if (outside.length > 0) results.push(ok(`UDP goes out; seen from there as ${outside.join(' and ')}`));
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
          : `${url} lends ${answer.relayed}, after ${answer.milliseconds.toFixed(0)} ms`,
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
  const remedy = `is the ${kind} server up, and may ${stream ? 'TCP' : 'UDP'} go there? Check name, port and firewalls`;
  return stream ? `${remedy}, then user name and credential` : remedy;
}

function refusedRemedy(status: number | null): string {
  if (status === 401 || status === 400)
    return 'wrong user name or credential: at the signaling service turnSecret must be the server’s own, and the clocks right';
  if (status === 486) return 'the user’s quota of allocations is used up: raise it at the server';
  if (status === 508) return 'the server has no more ports: raise its range';
  return 'check name and port, and the log of the server';
}

const isTurn = ({ url }: IceTarget) => url.startsWith('turn');
const host = (address: string) => address.slice(0, address.lastIndexOf(':'));
