/**
 * For unit tests: the page speaks English, as it does in a browser once its catalogues are loaded. A test that speaks another
 * language ends with English again, because all tests of a process share the modules.
 */
import { loadLaterTexts, speak } from '../words/language.ts';

await speak('en');
await loadLaterTexts();
