/** The two pages that this service writes itself: without scripts, for browsers that do not trust it yet. */
import type { ServerResponse } from 'node:http';

const STYLE = `
:root { color-scheme: dark; font: 125%/1.5 system-ui, sans-serif; }
body { margin: 0 auto; max-width: 34rem; padding: 2rem 1.25rem; background: #0b0f14; color: #e8edf2; }
h1 { font-size: 1.5rem; line-height: 1.25; }
a { color: #7cc4ff; }
.go, button { display: inline-block; padding: .75em 1.25em; border: 0; border-radius: .5em; background: #7cc4ff; color: #0b0f14; font: inherit; font-weight: 600; text-decoration: none; }
input { box-sizing: border-box; width: min(9em, 100%); padding: .5em; border: 2px solid #7cc4ff; border-radius: .5em; background: #131a22; color: inherit; font: inherit; font-size: 2rem; letter-spacing: .15em; }
form { display: flex; flex-wrap: wrap; gap: 1rem; align-items: center; }
code { overflow-wrap: anywhere; }
svg { display: block; width: min(100%, 16rem); background: #fff; border-radius: .5em; }
.warning { color: #ffc46b; }
`;

const HEADERS = {
  'cache-control': 'no-store',
  'cross-origin-opener-policy': 'same-origin',
  'cross-origin-resource-policy': 'same-origin',
  'referrer-policy': 'no-referrer',
  'x-content-type-options': 'nosniff',
  'x-frame-options': 'DENY',
} as const;

export function escapeHtml(text: string): string {
  return text.replace(/[&<>"']/g, (character) => `&#${character.charCodeAt(0)};`);
}

/** @param title as text @param body as HTML */
export function page(title: string, body: string): string {
  const head = `<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>${escapeHtml(title)} – Farpoint</title><style>${STYLE}</style>`;
  return `<!doctype html><html lang="en"><head>${head}</head><body><main><h1>${escapeHtml(title)}</h1>${body}</main></body></html>`;
}

/** @param formTarget where a form of the page leads in the end, besides this service: browsers check redirects, too */
export function sendPage(response: ServerResponse, status: number, html: string, formTarget = ''): void {
  const policy = `default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'self' ${formTarget}; frame-ancestors 'none'`;
  response.writeHead(status, {
    ...HEADERS,
    'content-security-policy': policy,
    'content-type': 'text/html; charset=utf-8',
    'content-length': Buffer.byteLength(html),
  });
  response.end(html);
}

export function sendRedirect(response: ServerResponse, location: string): void {
  response.writeHead(303, { ...HEADERS, location, 'content-length': 0 });
  response.end();
}

/** A file that browsers and headsets offer to install. */
export function sendCertificate(response: ServerResponse, pem: string): void {
  response.writeHead(200, {
    ...HEADERS,
    'content-type': 'application/x-x509-ca-cert',
    'content-disposition': 'attachment; filename="farpoint-authority.crt"',
    'content-length': Buffer.byteLength(pem),
  });
  response.end(pem);
}
