export * from './login-provider.ts';
export * from './sign-on.ts';
export * from './web-browser.ts';
