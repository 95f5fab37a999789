/** A grant or ticket in the page's address, `#grant=…`: a fragment is not sent to any server. */

/**
 * Takes the grant out of the address at once, so that neither the history nor a shared screen keeps it. The operator
 * still has to add it.
 *
 * @returns `null` if there is none
 */
export function takeGrantFromAddress(
  location: Pick<Location, 'hash' | 'pathname' | 'search'>,
  history: Pick<History, 'replaceState' | 'state'>,
): string | null {
  const given = new URLSearchParams(location.hash.slice(1)).get('grant');
  if (given === null) return null;
  history.replaceState(history.state, '', location.pathname + location.search);
  return given;
}
