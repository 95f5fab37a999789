/** The page on which a person agrees that a grant is made, and sees for whom. HTML without scripts. */
import type { Role } from '@farpoint/protocol';

/** What the person is asked. */
export interface Consent {
  /** Names the question, once. Not guessable. */
  readonly token: string;
  /** The page that gets the grant: its address. */
  readonly page: string;
  /** The person's name. */
  readonly person: string;
  readonly role: Role;
  /** Ids, or patterns of them. */
  readonly robots: readonly string[];
  readonly hours: number;
  /** Thumbprint of the key that the grant is for. */
  readonly key: string;
}

const ROLES: Readonly<Record<Role, string>> = {
  watch: 'watch',
  drive: 'drive',
  supervise: 'supervise (drive, take over, and end the sessions of others)',
};

/** @param action the path to which the answer goes */
export function consentPage(consent: Consent, action: string): string {
  const { token, page, person, role, robots, hours, key } = consent;
  const { origin, pathname, search } = new URL(page);
  const shown = escaped(`${origin}${pathname}${search}`);
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Sign in to ${escaped(origin)}</title>
</head>
<body>
<main>
<h1>Give ${escaped(origin)} a grant?</h1>
<p>You are signed in as <strong>${escaped(person)}</strong>. Whoever has the key below could then act in your name:</p>
<dl>
<dt>Page</dt><dd>${shown}</dd>
<dt>May</dt><dd>${ROLES[role]}</dd>
<dt>Robots</dt><dd>${robots.map(escaped).join(', ')}</dd>
<dt>For</dt><dd>${escaped(duration(hours))}</dd>
<dt>Key</dt><dd><code>${escaped(key)}</code></dd>
</dl>
<p>Go on only if you have just pressed “Sign in” on that page. If a link brought you here, cancel.</p>
<form method="post" action="${escaped(action)}">
<input type="hidden" name="token" value="${escaped(token)}">
<button name="answer" value="yes">Allow</button>
<button name="answer" value="no">Cancel</button>
</form>
</main>
</body>
</html>
`;
}

/** The directives by which a browser sends the answer here, and follows the redirect to the page. */
export function consentPolicy(page: string): string {
  return `default-src 'none'; base-uri 'none'; form-action 'self' ${new URL(page).origin}; frame-ancestors 'none'`;
}

function duration(hours: number): string {
  return hours >= 1 ? `${Math.round(hours * 10) / 10} h` : `${Math.round(hours * 60)} min`;
}

function escaped(text: string): string {
  return text.replace(/[&<>"'`]/g, (each) => `&#${each.charCodeAt(0)};`);
}
