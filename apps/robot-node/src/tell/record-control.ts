/** What operators may do with a robot's recordings. */
export interface RecordControl {
  readonly robotId: string;
  /** Where operators' recordings go, and the size of all of them, bytes; `null`: operators begin none. */
  readonly folder: { path: string; mostBytes: number } | null;
  /** Whether a file is being written now. */
  readonly writes: boolean;
  /** Whether that file is the robot's own, which no operator ends. */
  readonly isOwn: boolean;
  /** Of the file that is being written, or was written last: its size, and for how long. */
  readonly progress: { bytes: number; forS: number };
  /** @throws {Error} if the file cannot be created */
  start(path: string): Promise<void>;
  /** @returns the path of the file @throws {Error} if it cannot be completed */
  stop(): Promise<string | null>;
  /** Marks the present instant. @param by the operator's name @param text for people */
  bookmark(by: string, text: string): void;
}
