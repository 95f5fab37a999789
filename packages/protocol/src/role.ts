/** What an operator's grant lets it do. Everybody may latch the emergency stop. */
export const roles = [
  'watch', // see, and nothing that moves the robot
  'drive', // also take the lease and drive
  'supervise', // also take the lease from whoever has it, and release any emergency stop
] as const;
/**
 * What an operator's grant lets it do.
 *
 * @useDeclaredType
 */
export type Role = (typeof roles)[number];
