/** What operators of one robot ask of each other, through the robot. */
import type { Chat } from './chat.ts';
import type { DriveRequest } from './handover.ts';

export type PeopleRequest = DriveRequest | Chat;

const TYPES: ReadonlySet<string> = new Set<PeopleRequest['type']>([
  'driveAsk',
  'driveOffer',
  'driveAnswer',
  'driveWithdraw',
  'chat',
]);

export function isPeopleRequest<T extends { type: string }>(
  message: T,
): message is Extract<T, { type: PeopleRequest['type'] }> {
  return TYPES.has(message.type);
}
