/** Helpers of this package's tests. */
import { RosFault } from '@farpoint/ros';
import { isAvailable } from '../addon.ts';

/** Tests that need the addon name the command that builds it where they are left out. */
export const ADDON_SUITE = {
  skip: !isAvailable(),
  note: 'needs CycloneDDS and the addon: apt-get install cyclonedds-dev; pnpm build:native dds',
};

/** A domain that other tests at work on this machine do not use. Ports of higher ones are the system's to give away. */
export function testDomain(): number {
  return 1 + (process.pid % 100);
}

/** Resolves once `is` holds; what changes it is another thread or process. */
export async function until(is: () => boolean): Promise<void> {
  while (!is()) await new Promise((resolve) => setTimeout(resolve, 1));
}

/** What an action is refused with. */
export function faultOf(action: () => unknown): RosFault {
  try {
    action();
  } catch (error) {
    if (error instanceof RosFault) return error;
    throw error;
  }
  throw new Error('it was accepted');
}

/** A message of `content`, in little-endian CDR. */
export function cdr(...content: number[]): Uint8Array {
  return Uint8Array.of(0, 1, 0, 0, ...content);
}
