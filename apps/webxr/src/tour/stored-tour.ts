/** Whether somebody at this browser has been shown the first drive. */

const KEY = 'farpoint.tour';

export function wasTourShown(): boolean {
  try {
    return localStorage.getItem(KEY) !== null;
  } catch {
    // Without storage it would come with every visit.
    return true;
  }
}

export function rememberTour(): void {
  try {
    localStorage.setItem(KEY, 'shown');
  } catch {
    // It was started by hand.
  }
}
