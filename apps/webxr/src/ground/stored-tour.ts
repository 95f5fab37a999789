/** Whether this browser has shown the first drive to somebody, who has done or ended it. */

const KEY = 'farpoint.tour';

export function wasTourShown(): boolean {
  try {
    return localStorage.getItem(KEY) !== null;
  } catch {
    // Without storage it would be shown at every visit.
    return true;
  }
}

export function rememberTour(): void {
  try {
    localStorage.setItem(KEY, 'shown');
  } catch {
    // Private browsing: the operator started it from the help.
  }
}
