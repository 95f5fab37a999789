/** The running issuer. */
import { Counter, Gauge, type Health, type Logger, type Registry } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import { checkLengths, readSigningKey, required } from './issuer-files.ts';
import type { IssuerOptions } from './options.ts';
import { Provider } from './provider.ts';
import { type RunningServer, startServer } from './server.ts';
import { type Outcome, SignInDesk } from './sign-in-desk.ts';

export interface IssuerRim {
  readonly log: Logger;
  readonly health: Health;
  readonly metrics: Registry;
  readonly where: (key: keyof IssuerOptions & string) => string;
}

/** @throws {OptionsError} for options that are missing or do not fit; {Error} if the port cannot be opened */
export async function startIssuer(options: IssuerOptions, rim: IssuerRim): Promise<RunningServer> {
  const { log, health, metrics, where } = rim;
  const { hours, robotKeys, rules, pages, signInsPerMinute, host, port, trustProxy } = options;
  const { url: given, provider: issuer, clientId } = required(options, where);
  const url = given.replace(/\/$/, '');
  const terms = { issuer: url, hours, robotKeys };
  const { key: signingKey, exposed } = await readSigningKey(where('key'), options.key);
  if (exposed)
    log.warn({ key: options.key }, 'other users of this machine may read the private key: chmod 600');
  await checkLengths(rules, terms, signingKey, where);
  const provider = new Provider(
    {
      provider: issuer,
      clientId,
      clientSecret: options.clientSecret,
      scope: options.scope,
      userInfo: options.userInfo,
      timeoutMs: options.providerTimeoutMs,
    },
    `${url}/callback`,
  );
  const onOutcome = observer(log, metrics);
  const desk = new SignInDesk({ provider, signingKey, terms, rules, pages, signInsPerMinute, onOutcome });
  new Gauge({
    name: 'farpoint_issuer_pending_sign_ins',
    help: 'Sign-ins that have begun and not ended',
    registers: [metrics],
    collect() {
      this.set(desk.pending);
    },
  });
  // A provider that is away is no fault of this program: a restart would not help.
  health.add('provider', () => ({ ok: true, detail: { reachable: provider.reachable } }));
  const server = await startServer(desk, {
    host,
    port,
    url,
    trustProxy,
    now: Date.now,
    onError: (error) => log.error({ err: error }, 'a request failed'),
  });
  log.info({ host, port: server.port, url, provider: issuer, rules: rules.length }, 'listening');
  return server;
}

/** Counts how sign-ins end, and logs it. Strangers cannot write more than a line a second. */
function observer(log: Logger, metrics: Registry) {
  const outcomes = new Counter({
    name: 'farpoint_issuer_sign_ins_total',
    help: 'Sign-ins by how they ended',
    labelNames: ['outcome'],
    registers: [metrics],
  });
  const lines = new TokenBucket({ perSecond: 1, burst: 10 });
  return (outcome: Outcome, facts: Readonly<Record<string, string>>): void => {
    outcomes.inc({ outcome });
    if (outcome === 'granted') log.info(facts, 'granted');
    else if (lines.take(performance.now())) log.warn({ ...facts, reason: outcome }, 'nobody signed in');
  };
}
