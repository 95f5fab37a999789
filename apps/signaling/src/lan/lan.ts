/** Opens what `--lan` needs: the authority, a certificate for this machine's addresses, and pairing. */
import { X509Certificate } from 'node:crypto';
import { readFileSync } from 'node:fs';
import type { RequestListener } from 'node:http';
import { isIP } from 'node:net';
import { homedir } from 'node:os';
import { join } from 'node:path';
import { GrantKeysError, parseSigningKey, type SigningKey } from '@farpoint/grants';
import {
  AuthorityError,
  isLocalHost,
  issueCertificate,
  localAddresses,
  type NetworkInterfaces,
  openAuthority,
} from '@farpoint/local-authority';
import { fileFault, type Logger, OptionsError } from '@farpoint/service';
import type { TlsFiles } from '../listener.ts';
import type { SignalingOptions } from '../options.ts';
import { installHandler, PAIRING_PATH, pairingHandler } from './lan-handler.ts';
import { PairingCodes } from './pairing-codes.ts';
import { PairingDesk } from './pairing-desk.ts';

export type LanOptions = Pick<
  SignalingOptions,
  | 'port'
  | 'lanPort'
  | 'lanInstallPort'
  | 'lanHosts'
  | 'authorityDir'
  | 'pairKey'
  | 'pairHours'
  | 'allowedOrigins'
>;

export interface LanRim {
  readonly log: Logger;
  readonly now: () => number;
  readonly hostname: string;
  readonly interfaces: NetworkInterfaces;
  /** As `crypto.randomInt`. */
  readonly random: (below: number) => number;
  /** Shows text to whoever started the service. */
  readonly say: (text: string) => void;
}

/** The service as the local network sees it. */
export interface Lan {
  readonly tls: TlsFiles;
  /** Addresses of the page for operators, the likeliest first. */
  readonly addresses: readonly string[];
  /** Of the page for the certificate. */
  readonly installAddress: string;
  /** The authority's certificate, SHA-256. */
  readonly fingerprint: string;
  /** Answers requests for pairing; leaves others to the given one. */
  readonly withPairing: (next: RequestListener) => RequestListener;
  readonly install: RequestListener;
  /** Where an operator at this address pairs; `null` if there is no pairing. */
  readonly pairingUrl: (isThisMachine: boolean) => string | null;
}

/** @throws {OptionsError} naming the option and the cure */
export async function openLan(options: LanOptions, rim: LanRim): Promise<Lan> {
  const { port, lanPort, lanInstallPort, pairKey, allowedOrigins } = options;
  const hosts = hostsOf(options, rim);
  const now = new Date(rim.now());
  const folder = options.authorityDir ?? join(homedir(), '.config', 'farpoint', 'authority');
  const authority = await openAuthority(folder, { name: `Farpoint on ${rim.hostname}`, now }).catch(
    (error: unknown) => {
      const detail = error instanceof Error ? error.message : String(error);
      throw new OptionsError(
        `--authority-dir ${folder}`,
        error instanceof AuthorityError ? `${detail}; remove the file for a new authority` : detail,
      );
    },
  );
  const issued = await issueCertificate(authority, { hosts, now });
  const addresses = hosts.map((host) => addressOf('https', host, lanPort));
  const [first] = hosts as [string];
  const desk =
    pairKey === null
      ? null
      : await pairingDesk(pairKey, options, rim, [
          ...addresses,
          ...allowedOrigins,
          `http://localhost:${port}/`,
          `http://127.0.0.1:${port}/`,
        ]);
  const { fingerprint256: fingerprint } = new X509Certificate(authority.certificate);
  return {
    tls: { cert: Buffer.from(issued.certificate), key: Buffer.from(issued.key) },
    ...{ addresses, fingerprint, installAddress: addressOf('http', first, lanInstallPort) },
    withPairing: (next) => (desk === null ? next : pairingHandler(desk, rim.now, next)),
    install: installHandler(addresses, { certificate: authority.certificate, fingerprint }),
    pairingUrl: (isThisMachine) => {
      if (desk === null) return null;
      return `${isThisMachine ? `http://localhost:${port}` : addresses[0]?.replace(/\/$/, '')}${PAIRING_PATH}`;
    },
  };
}

function hostsOf({ lanHosts }: LanOptions, { hostname, interfaces }: LanRim): string[] {
  const foreign = lanHosts.find((host) => !isLocalHost(host));
  if (foreign !== undefined)
    throw new OptionsError('--lan-hosts', `${foreign} is not a name or an address of a local network`);
  const name = `${hostname.toLowerCase().split('.', 1)[0]}.local`;
  const found = localAddresses(interfaces).map(({ address }) => address);
  const hosts = [...new Set([...lanHosts, ...found, ...(isLocalHost(name) ? [name] : [])])];
  if (lanHosts.length === 0 && found.length === 0)
    throw new OptionsError(
      '--lan',
      'needs an address on a local network, and this machine has none: connect it to one, or name one with --lan-hosts',
    );
  return hosts;
}

function addressOf(scheme: 'http' | 'https', host: string, port: number): string {
  return `${scheme}://${isIP(host) === 6 ? `[${host}]` : host}:${port}/`;
}

async function pairingDesk(
  path: string,
  { pairHours: hours }: LanOptions,
  { log, now, random, say }: LanRim,
  pages: readonly string[],
): Promise<PairingDesk> {
  const signingKey = await readSigningKey(path);
  const origins = new Set(pages.map((each) => URL.parse(each)?.origin));
  const codes = new PairingCodes({
    random,
    onCode: (digits, untilMs) => {
      const minutes = Math.round((untilMs - now()) / 60_000);
      say(
        `\n  Pairing code  ${digits.slice(0, 3)} ${digits.slice(3)}  (for one browser, ${minutes} minutes)\n`,
      );
      // The code itself is for people before this terminal, not for logs that are kept.
      log.info({ minutes }, 'a browser waits for its pairing code');
    },
  });
  return new PairingDesk({
    ...{ codes, signingKey, hours },
    isOwnPage: (address) => origins.has(new URL(address).origin),
    onPaired: (facts) => log.info(facts, 'paired a browser'),
  });
}

async function readSigningKey(path: string): Promise<SigningKey> {
  try {
    return await parseSigningKey(readFileSync(path, 'utf8'));
  } catch (error) {
    const detail =
      error instanceof GrantKeysError ? `${path} ${error.message}` : (fileFault(error) ?? String(error));
    throw new OptionsError('--pair-key', `${detail} (make one: farpoint-signaling grant keygen)`);
  }
}
