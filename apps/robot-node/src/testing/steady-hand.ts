import type { Twist } from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import type { OperatorClient } from './operator-client.ts';

const COMMAND_MS = 20;

/**
 * Drives on until it is stopped. The client's hand lets go when the robot asks for it.
 *
 * @returns stops it
 */
export function steadyHand(client: OperatorClient, lease: string, twist: Twist): () => void {
  const timer = setInterval(() => {
    if (client.control.readyState === 'open') client.drive(lease, 0, { twist });
  }, COMMAND_MS);
  return () => clearInterval(timer);
}

/** Drives straight on, as a page does, until `is` holds. The client's hand lets go when the robot asks for it. */
export async function driveUntil(
  client: OperatorClient,
  lease: string,
  linear: number,
  is: () => boolean,
): Promise<void> {
  const timer = setInterval(() => client.drive(lease, linear), COMMAND_MS);
  try {
    await eventually(is);
  } finally {
    clearInterval(timer);
  }
}
