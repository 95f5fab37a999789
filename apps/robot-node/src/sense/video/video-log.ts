/** What a camera's encoder says for the log. The log itself, or a thread's way to it. */
export interface VideoLog {
  debug(fields: object, message: string): void;
  info(fields: object, message: string): void;
  warn(fields: object, message: string): void;
  error(fields: object, message: string): void;
}
