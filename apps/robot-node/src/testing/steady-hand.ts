import type { Twist } from '@farpoint/protocol';
import type { OperatorClient } from './operator-client.ts';

const COMMAND_MS = 20;

/**
 * Drives on until it is stopped, by a hand that lets go when the robot asks for it: a busy machine may keep commands back
 * for so long that the robot wants a fresh grip.
 *
 * @returns stops it
 */
export function steadyHand(client: OperatorClient, lease: string, twist: Twist): () => void {
  let letGo = 0;
  const timer = setInterval(() => {
    if (client.control.readyState !== 'open') return;
    const asked = client.session.filter(
      (message) => message.type === 'rejected' && message.reason === 'let-go-first',
    ).length;
    if (asked > letGo) client.drive(lease, 0, { deadMan: false });
    letGo = asked;
    client.drive(lease, 0, { twist });
  }, COMMAND_MS);
  return () => clearInterval(timer);
}
