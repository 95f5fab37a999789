/** Helpers for this package's tests. */
import { reserveNumberNow } from '@farpoint/local-stack/reserved-numbers';
import { RosFault } from '@farpoint/ros';
import { thrown } from '@farpoint/service/testing/thrown';
import { isAvailable } from '../addon.ts';

/** Tests that need the addon are skipped without it, and then name the command that builds it. */
export const ADDON_SUITE = {
  skip: !isAvailable(),
  note: 'needs CycloneDDS and the addon: apt-get install cyclonedds-dev; pnpm build:native dds',
};

/** Their ports, UDP 7400 + 250 × domain and on, are below those of Janus and of outgoing packets. */
const DOMAINS = { kind: 'dds-domain', first: 1, last: 49 };
let domain: number | null = null;

/** A domain of this thread, that no other test on this machine uses. */
export function testDomain(): number {
  domain ??= reserveNumberNow(DOMAINS);
  return domain;
}

/** The fault that an action throws. */
export const faultOf = (action: () => unknown): RosFault => thrown(RosFault, action);

/** A message with `content`, in little-endian CDR. */
export function cdr(...content: number[]): Uint8Array {
  return Uint8Array.of(0, 1, 0, 0, ...content);
}
