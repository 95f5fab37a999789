import type { CommandAction } from './command-configuration.ts';

/** What became of an action. */
export interface ActionResult {
  state: 'done' | 'failed' | 'cancelled';
  /** For people; may be empty. */
  detail: string;
}

/** One action that is to be done. */
export interface CommandOrder {
  readonly action: CommandAction;
  readonly timeoutMs: number;
  /** The name of the operator who gave it. */
  readonly by: string;
  /** Of a bookmark; otherwise empty. */
  readonly text: string;
}

/** What an action tells while it is done. */
export interface ActionPort {
  /** @param share how much of it is done, 0–1; `null` if nobody can tell @param detail for people; may be empty */
  progress(share: number | null, detail: string): void;
  /** Once, unless nothing ever answers. */
  end(result: ActionResult): void;
}

/** What does the commands’ actions. */
export interface CommandActor {
  /** @returns asks for the action to be cancelled, which is confirmed by its end; `null` if it cannot be */
  begin(order: CommandOrder, port: ActionPort): (() => void) | null;
  close(): Promise<void>;
}

/** Whether this kind of action can be cancelled while it is done. */
export function isCancellable(action: CommandAction): boolean {
  return action.kind === 'goal' || (action.kind === 'sim' && action.action === 'self-test');
}
