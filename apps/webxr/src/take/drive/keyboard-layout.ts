/** What is written on the keys of this keyboard, where the browser tells. */
import { type Signal, signal } from '@preact/signals-core';

/** What a key types without Shift, by `KeyboardEvent.code`; empty where it is not known. */
export const keyboardLayout: Signal<ReadonlyMap<string, string>> = signal(new Map());

/** The part of `Navigator` that some browsers have: https://wicg.github.io/keyboard-map/ */
interface NavigatorWithKeyboard {
  readonly keyboard?: { getLayoutMap?(): Promise<Iterable<readonly [string, string]>> };
}

/** Asks the browser. Without an answer, keys have the names of a US keyboard. @param navigator the browser's */
export async function readKeyboardLayout(navigator: object): Promise<void> {
  try {
    const { keyboard } = navigator as NavigatorWithKeyboard;
    const layout = await keyboard?.getLayoutMap?.();
    if (layout !== undefined) keyboardLayout.value = new Map(layout);
  } catch {
    // Forbidden in this frame.
  }
}
