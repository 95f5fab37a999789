/** What the service must not do without being asked: let the whole network in, or have secrets sent in the clear. */
import { isLoopbackHost } from '@farpoint/protocol';
import { OptionsError } from '@farpoint/service';
import type { SignalingOptions } from './options.ts';
import type { ServiceFiles } from './service-files.ts';

export type ExposureOptions = Pick<
  SignalingOptions,
  'host' | 'open' | 'plaintextTokens' | 'reference' | 'referenceOpen' | 'trustProxy' | 'metricsToken'
>;

/**
 * Checks what others than this machine's own programs may do.
 *
 * @throws {OptionsError} naming the option and the cure
 */
export function checkExposure(
  options: ExposureOptions,
  files: Pick<ServiceFiles, 'tls' | 'robots' | 'operators'>,
): void {
  const { host, open, plaintextTokens, reference, referenceOpen, trustProxy } = options;
  // Behind a proxy on the same machine, loopback is not private either.
  const isBehindProxy = trustProxy.length > 0;
  if (isLoopbackHost(host) && !isBehindProxy) return;
  const where = isBehindProxy ? 'behind a proxy' : `at ${host}`;
  const { robots, operators, tls } = files;
  if (!open && (robots.open || operators.open)) {
    const missing = [robots.open ? '--robot-tokens' : null, operators.open ? '--operator-tokens' : null]
      .filter((each) => each !== null)
      .join(' and ');
    throw new OptionsError(
      isBehindProxy ? '--trust-proxy' : '--host',
      `lets everybody in who reaches the service ${where}: set ${missing}, or --open if that is what you want (because every robot asks for grants, for example)`,
    );
  }
  if (!open && reference && referenceOpen)
    throw new OptionsError(
      '--reference-open',
      `lets everybody drive the reference system's robots ${where}: leave it out, or set --open if that is what you want`,
    );
  const hasTokens = !robots.open || !operators.open || options.metricsToken !== null;
  if (hasTokens && tls === null && !isBehindProxy && !plaintextTokens)
    throw new OptionsError(
      '--host',
      `would have tokens sent to ${host} in the clear: set --tls-cert and --tls-key, put a proxy with TLS in front (--trust-proxy), or allow it with --plaintext-tokens`,
    );
}
