/** A part of the page whose code and texts are loaded when it is first needed, so that the page starts without them. */
import type { Notices } from '../../state/notices.ts';
import { loadLaterTexts, texts } from '../../words/language.ts';

export class LaterPart<Code> {
  readonly #load: () => Promise<Code>;
  readonly #notices: Pick<Notices, 'tell'>;
  #isLoading = false;

  /** @param load imports the code, which the browser keeps */
  constructor(load: () => Promise<Code>, notices: Pick<Notices, 'tell'>) {
    this.#load = load;
    this.#notices = notices;
  }

  /** Loads the part and uses it. Does nothing while it is being loaded. Where it cannot be loaded, a notice says so. */
  async use(use: (code: Code) => void, onFailed: () => void = () => undefined): Promise<void> {
    if (this.#isLoading) return;
    this.#isLoading = true;
    try {
      const [code] = await Promise.all([this.#load(), loadLaterTexts()]);
      this.#isLoading = false;
      use(code);
    } catch (error) {
      console.error(error);
      this.#isLoading = false;
      this.#notices.tell(texts().dialogs.cannotLoad, 'warning');
      onFailed();
    }
  }
}
