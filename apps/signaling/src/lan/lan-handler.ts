/** The HTTP of the local network: pairing over TLS, and the page for the certificate without. */
import type { IncomingMessage, RequestListener, ServerResponse } from 'node:http';
import { CERTIFICATE_PATH, installPage } from './install-page.ts';
import { page, sendCertificate, sendPage, sendRedirect } from './page.ts';
import type { PairingDesk, PairingReply } from './pairing-desk.ts';
import { pairingPage } from './pairing-page.ts';

export const PAIRING_PATH = '/pair';
/** A form of one request and one code is shorter. */
const MOST_FORM_BYTES = 8192;

/** Answers requests for {@link PAIRING_PATH}; leaves all others to `next`. */
export function pairingHandler(desk: PairingDesk, now: () => number, next: RequestListener): RequestListener {
  return (request, response) => {
    const url = URL.parse(request.url ?? '', 'http://service');
    if (url?.pathname !== PAIRING_PATH) return next(request, response);
    if (request.method === 'GET') return answer(response, desk.begin(url.searchParams, now()));
    if (request.method !== 'POST') return refuse(response, 405, 'Only GET and POST.');
    void readForm(request).then(
      async (form) => {
        if (form === null) refuse(response, 413, 'That is too long.');
        else answer(response, await desk.finish(form, now()));
      },
      () => response.destroy(),
    );
  };
}

/** The page for the certificate, and the certificate. */
export function installHandler(
  addresses: readonly string[],
  authority: { readonly certificate: string; readonly fingerprint: string },
): RequestListener {
  const html = installPage(addresses, authority.fingerprint);
  return (request, response) => {
    const path = URL.parse(request.url ?? '', 'http://service')?.pathname;
    if (request.method !== 'GET' && request.method !== 'HEAD') refuse(response, 405, 'Only GET.');
    else if (path === CERTIFICATE_PATH) sendCertificate(response, authority.certificate);
    else if (path === '/') sendPage(response, 200, html);
    else refuse(response, 404, 'Nothing here.');
  };
}

function answer(response: ServerResponse, reply: PairingReply): void {
  if ('redirect' in reply) sendRedirect(response, reply.redirect);
  else if ('status' in reply) refuse(response, reply.status, reply.text);
  else {
    const { request, prompt } = reply;
    const { origin } = new URL(request.return);
    sendPage(response, prompt === 'type' ? 200 : 403, pairingPage(request, prompt), origin);
  }
}

function refuse(response: ServerResponse, status: number, text: string): void {
  sendPage(response, status, page('Not here', `<p>${text}</p>`));
}

/** @returns `null` if it is too long */
async function readForm(request: IncomingMessage): Promise<URLSearchParams | null> {
  const chunks: Buffer[] = [];
  let length = 0;
  for await (const chunk of request as AsyncIterable<Buffer>) {
    length += chunk.length;
    if (length > MOST_FORM_BYTES) return null;
    chunks.push(chunk);
  }
  return new URLSearchParams(Buffer.concat(chunks).toString('utf8'));
}
