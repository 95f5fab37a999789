/** Registers with the signaling service for a moment, as the robot would, and reports its answer. */
import { randomBytes } from 'node:crypto';
import { request as httpRequest } from 'node:http';
import { request as httpsRequest } from 'node:https';
import { TLSSocket } from 'node:tls';
import {
  decodeJson,
  encodeJson,
  type IceServer,
  MAX_SIGNALING_BYTES,
  PROTOCOL_VERSION,
  robotToServiceCodec,
  type SignalingErrorCode,
  serviceToRobotCodec,
  signalingEndpoint,
} from '@farpoint/protocol';
import { WebSocket } from 'ws';
import type { SignalingOptions } from '../../admit/signaling/signaling-client.ts';
import type { ServerTime } from './check-clock.ts';

export type SignalingTarget = Pick<SignalingOptions, 'url' | 'id' | 'name' | 'token' | 'ca'>;

/** The outcome of the probe. */
export type SignalingAnswer =
  | {
      outcome: 'welcome';
      iceServers: readonly IceServer[];
      milliseconds: number;
      /** When the service's certificate expires, ms since 1970; `null` without TLS. */
      certificateUntilMs: number | null;
    }
  | { outcome: 'refused'; code: SignalingErrorCode; detail: string }
  /** The WebSocket could not be opened; `code` as the system or TLS names it, `''` if neither does. */
  | { outcome: 'unreachable'; code: string; detail: string }
  /** The WebSocket was opened, but no message arrived in time. */
  | { outcome: 'silent' }
  /** The message that arrived is not one of ours. */
  | { outcome: 'unreadable'; detail: string };

/**
 * Uses a random key, so that a robot already registered under this id stays registered: the service refuses us, not
 * it.
 *
 * @param withinMs time limit for everything
 */
export function probeSignaling(
  target: SignalingTarget,
  withinMs: number,
  now: () => number,
): Promise<SignalingAnswer> {
  const { url, id, name, token, ca } = target;
  const begin = now();
  let certificateUntilMs: number | null = null;
  const socket = new WebSocket(signalingEndpoint(url, 'robot'), {
    handshakeTimeout: withinMs,
    maxPayload: MAX_SIGNALING_BYTES,
    perMessageDeflate: false,
    ...(ca === null ? {} : { ca }),
  });
  return new Promise((resolve) => {
    const end = (answer: SignalingAnswer) => {
      clearTimeout(timer);
      resolve(answer);
      socket.close();
      // A service that does not answer the close is not waited for.
      setTimeout(() => socket.terminate(), 200).unref();
    };
    const timer = setTimeout(() => end({ outcome: 'silent' }), withinMs);
    socket.on('upgrade', ({ socket: line }) => {
      if (line instanceof TLSSocket)
        certificateUntilMs = Date.parse(line.getPeerCertificate().valid_to) || null;
    });
    socket.on('open', () => {
      const key = randomBytes(16).toString('hex');
      const hello = { type: 'robot.hello', protocol: PROTOCOL_VERSION, id, name, key } as const;
      socket.send(
        encodeJson(robotToServiceCodec, { ...hello, ...(token === null ? {} : { token: token.reveal() }) }),
      );
    });
    socket.on('message', (data: Buffer, binary: boolean) => {
      try {
        const message = decodeJson(serviceToRobotCodec, binary ? data : data.toString('utf8'));
        if (message.type === 'robot.welcome')
          end({
            outcome: 'welcome',
            iceServers: message.iceServers,
            milliseconds: now() - begin,
            certificateUntilMs,
          });
        else if (message.type === 'error')
          end({ outcome: 'refused', code: message.code, detail: message.message });
      } catch (error) {
        end({ outcome: 'unreadable', detail: (error as Error).message });
      }
    });
    socket.on('error', (error) => {
      const { code = '', message } = error as NodeJS.ErrnoException;
      // With several addresses, only the code says what failed.
      end({ outcome: 'unreachable', code, detail: message || code });
    });
    socket.on('close', (code) => end({ outcome: 'unreadable', detail: `closed with code ${code}` }));
  });
}

/** The service's `Date`; `null` if there is none. */
export function askTime(
  target: SignalingTarget,
  withinMs: number,
  nowMs: () => number,
): Promise<ServerTime | null> {
  const url = signalingEndpoint(target.url.replace(/^ws/, 'http'), 'healthz');
  const request = url.protocol === 'https:' ? httpsRequest : httpRequest;
  return new Promise((resolve) => {
    const askedMs = nowMs();
    const asking = request(url, {
      method: 'GET',
      agent: false,
      ...(target.ca === null ? {} : { ca: target.ca }),
    });
    const end = (time: ServerTime | null) => {
      clearTimeout(timer);
      resolve(time);
      asking.destroy();
    };
    const timer = setTimeout(() => end(null), withinMs);
    asking.on('response', ({ headers }) => {
      const dateMs = Date.parse(headers.date ?? '');
      end(Number.isNaN(dateMs) ? null : { dateMs, askedMs, answeredMs: nowMs() });
    });
    asking.on('error', () => end(null));
    asking.end();
  });
}
