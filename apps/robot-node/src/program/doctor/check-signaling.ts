/** Judges the signaling service's answer, and says what to do about it. */
import type { SignalingErrorCode } from '@farpoint/protocol';
import { fail, ok, type Result, warn } from './finding.ts';
import type { SignalingAnswer } from './signaling-probe.ts';

/**
 * A certificate that ends sooner is told. Chosen: ACME clients renew a month before the end, so a renewal
 * that fails shows two weeks later.
 */
const EASY_CERTIFICATE_DAYS = 14;
const DAY_MS = 86_400_000;

/**
 * @param robotRuns whether a robot runs on this machine, which then has the id
 * @param nowMs the time of day, ms since 1970
 */
export function judgeSignaling(
  url: string,
  id: string,
  answer: SignalingAnswer,
  robotRuns: boolean,
  nowMs: number,
): Result[] {
  switch (answer.outcome) {
    case 'welcome': {
      const results = [ok(`${url} accepts robot ${id}, after ${answer.milliseconds.toFixed(0)} ms`)];
      const { protocol, hostname } = new URL(url);
      const local = /^(localhost|127\.|\[::1\])/.test(hostname);
      if (protocol === 'ws:' && !local)
        results.push(
          warn(
            'the connection to it is not encrypted: token and offers can be read',
            'use wss://, with TLS at the service',
          ),
        );
      const days = ((answer.certificateUntilMs ?? Number.POSITIVE_INFINITY) - nowMs) / DAY_MS;
      if (days < EASY_CERTIFICATE_DAYS)
        results.push(
          warn(
            `its certificate expires in ${Math.floor(days)} days`,
            'renew it: with an expired one nobody can connect',
          ),
        );
      return results;
    }
    case 'refused':
      return [judgeRefusal(url, id, answer.code, answer.detail, robotRuns)];
    case 'silent':
      return [
        fail(
          `${url} accepts the connection and says nothing`,
          'is it Farpoint’s signaling service? See its log',
        ),
      ];
    case 'unreadable':
      return [
        fail(
          `${url} does not speak Farpoint’s protocol: ${answer.detail}`,
          'set signaling.url to Farpoint’s signaling service, of a matching version',
        ),
      ];
    case 'unreachable':
      return [
        fail(`${url} cannot be reached: ${answer.detail}`, unreachableRemedy(answer.code, answer.detail)),
      ];
  }
}

function judgeRefusal(
  url: string,
  id: string,
  code: SignalingErrorCode,
  detail: string,
  robotRuns: boolean,
): Result {
  switch (code) {
    case 'robot-id-taken':
      return robotRuns
        ? ok(`${url}: robot ${id} is registered`)
        : fail(`${url}: a robot ${id} is already registered`, 'stop that robot, or give this one another id');
    case 'unauthorized':
      return fail(
        `${url} refuses robot ${id}: ${detail}`,
        'set FARPOINT_ROBOT_TOKEN to the service’s token for this id',
      );
    case 'unsupported-protocol':
      return fail(`${url} refuses: ${detail}`, 'update robot and signaling service to the same version');
    default:
      return fail(`${url} refuses: ${code}: ${detail}`, 'see the signaling service’s log');
  }
}

function unreachableRemedy(code: string, detail: string): string {
  if (/^(ENOTFOUND|EAI_AGAIN)$/.test(code))
    return 'check the name in signaling.url, and name resolution on this machine';
  if (code === 'ECONNREFUSED')
    return 'nothing listens there: check host and port in signaling.url, and start the service';
  if (/^(EHOSTUNREACH|ENETUNREACH|ETIMEDOUT)$/.test(code) || /timed out/.test(detail))
    return 'check the network path: cable or radio, routes, firewalls';
  if (code === 'CERT_HAS_EXPIRED' || code === 'CERT_NOT_YET_VALID')
    return 'renew the service’s certificate, or correct this machine’s time';
  if (/CERT|SIGNED|SIGNATURE|ISSUER/.test(code))
    return 'set signaling.tlsCa to the authority that signed its certificate, or use the host name in the certificate';
  if (/EPROTO|SSL|TLS|hang up|ECONNRESET/.test(`${code} ${detail}`))
    return 'does the service use TLS there? wss:// needs it, ws:// does without';
  if (/server response/.test(detail))
    return 'something else answers there: check host and port in signaling.url';
  return 'check signaling.url';
}
