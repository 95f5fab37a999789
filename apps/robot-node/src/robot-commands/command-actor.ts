import type { CommandAction } from './command-configuration.ts';

/** What became of an action. */
export interface ActionResult {
  done: boolean;
  /** For people; may be empty. */
  detail: string;
}

/** What does the commands’ actions. */
export interface CommandActor {
  /** @param onResult called once, unless nothing ever answers @param by the name of the operator who gave the command */
  act(action: CommandAction, timeoutMs: number, onResult: (result: ActionResult) => void, by: string): void;
  close(): Promise<void>;
}
