import type { Twist } from '@farpoint/protocol';
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
