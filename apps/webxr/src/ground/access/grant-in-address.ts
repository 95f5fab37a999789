/** A grant or ticket in the page's address, `#grant=…`, or what an issuer answers to a sign-in. */
import { parseSignInAnswer, type SignInAnswer } from '@farpoint/protocol';

/**
 * Takes the grant out of the address at once, so that neither the history nor a shared screen keeps it. Unless the page
 * asked for it, the operator still has to add it.
 *
 * @returns `null` if there is none
 */
export function takeGrantFromAddress(
  location: Pick<Location, 'hash' | 'pathname' | 'search'>,
  history: Pick<History, 'replaceState' | 'state'>,
): SignInAnswer | null {
  const answer = parseSignInAnswer(location.hash);
  if (answer !== null) history.replaceState(history.state, '', location.pathname + location.search);
  return answer;
}
