/**
 * Writes what the page's HTML says, in the page's language. An element names its texts in the catalogue as `area.key`: `data-text`
 * its content, `data-keys` content in which brackets make a key, `data-title`, `data-label` what is read aloud of it, and
 * `data-placeholder`.
 */
import { language, speak, textAt } from '../../words/language.ts';
import { splitKeys } from './split-keys.ts';
import { wantedLanguage } from './wanted-language.ts';

const WAYS: Readonly<Record<string, (element: HTMLElement, text: string) => void>> = {
  text(element, text) {
    element.textContent = text;
  },
  keys(element, text) {
    element.replaceChildren(...splitKeys(text).map(partOf));
  },
  title(element, text) {
    element.title = text;
  },
  label(element, text) {
    element.ariaLabel = text;
  },
  placeholder(element, text) {
    (element as HTMLInputElement).placeholder = text;
  },
};

function partOf({ text, isKey }: { text: string; isKey: boolean }): Node {
  if (!isKey) return document.createTextNode(text);
  const key = document.createElement('kbd');
  key.textContent = text;
  return key;
}

/**
 * Loads the language that was chosen, or else the browser's, and writes the page's texts. Without its catalogue the page speaks
 * English. Call it before anything is shown.
 */
export async function startLanguage(): Promise<void> {
  const wanted = wantedLanguage();
  try {
    await speak(wanted);
  } catch (error) {
    console.warn(`no texts in “${wanted}”: the page speaks English`, error);
    await speak('en');
  }
  document.documentElement.lang = language();
  for (const [name, write] of Object.entries(WAYS))
    for (const element of document.querySelectorAll<HTMLElement>(`[data-${name}]`))
      write(element, textAt(element.dataset[name] ?? ''));
}
