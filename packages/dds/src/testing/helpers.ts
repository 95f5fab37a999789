/** Helpers for this package's tests. */
import { RosFault } from '@farpoint/ros';
import { isAvailable } from '../addon.ts';

/** Tests that need the addon are skipped without it, and then name the command that builds it. */
export const ADDON_SUITE = {
  skip: !isAvailable(),
  note: 'needs CycloneDDS and the addon: apt-get install cyclonedds-dev; pnpm build:native dds',
};

/** A domain that no other test on this machine uses. The system may assign the ports of higher domains to others. */
export function testDomain(): number {
  return 1 + (process.pid % 100);
}

/** Resolves once `is` returns true; another thread or process changes its result. */
export async function until(is: () => boolean): Promise<void> {
  while (!is()) await new Promise((resolve) => setTimeout(resolve, 1));
}

/** The fault that an action throws. */
export function faultOf(action: () => unknown): RosFault {
  try {
    action();
  } catch (error) {
    if (error instanceof RosFault) return error;
    throw error;
  }
  throw new Error('it was accepted');
}

/** A message with `content`, in little-endian CDR. */
export function cdr(...content: number[]): Uint8Array {
  return Uint8Array.of(0, 1, 0, 0, ...content);
}
