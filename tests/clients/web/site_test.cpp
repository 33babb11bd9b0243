#include "clients/web/site.h"

#include <gtest/gtest.h>

namespace flexcast::web {
namespace {

class SiteTest : public testing::Test {
 protected:
  HttpReply get(const std::string& target, const std::string& accept = "gzip, deflate") const {
    return site_.answer({.method = "GET", .target = target, .host = "localhost", .accept_encoding = accept});
  }
  static std::string header(const HttpReply& reply, std::string_view name) {
    for (const auto& [key, value] : reply.headers)
      if (key == name) return value;
    return "";
  }
  static HttpRequest upgrade_request() {
    return {
        .method = "GET", .target = "/", .host = "localhost", .subprotocols = "x, foxglove.sdk.v1", .is_upgrade = true};
  }

  bool full_ = false;
  Site site_{Gate("127.0.0.1", {}), assets(), [this] { return full_; }};
};

TEST_F(SiteTest, TheTableOfAssetsIsServedAndNothingElse) {
  EXPECT_EQ(get("/").status, 200u);
  EXPECT_EQ(get("/?world=rope").status, 200u);
  EXPECT_EQ(get("/assets/ok.txt").status, 200u);
  for (const char* target : {"/assets/", "/assets", "//", "/../etc/passwd", "/assets/../", "", "/assets/ok.txt/"})
    EXPECT_EQ(get(target).status, 404u) << target;
}

TEST_F(SiteTest, CompressedFilesGoToThoseWhoTakeThem) {
  EXPECT_EQ(header(get("/assets/ok.txt"), "Content-Encoding"), "gzip");
  EXPECT_EQ(header(get("/"), "Content-Encoding"), "");
  for (const char* accept : {"gzip", "br, gzip;q=0.5", "*", "deflate,gzip"})
    EXPECT_EQ(get("/assets/ok.txt", accept).status, 200u) << accept;
  for (const char* accept : {"", "br", "gzip;q=0", "gzip;q=0.0", "xgzip"})
    EXPECT_EQ(get("/assets/ok.txt", accept).status, 406u) << accept;
}

TEST_F(SiteTest, AFileThatIsKnownIsNotSentAgain) {
  const std::string tag = header(get("/"), "ETag");
  HttpRequest request{.method = "GET", .target = "/", .host = "localhost", .if_none_match = "\"1\", " + tag};
  const HttpReply reply = site_.answer(request);
  EXPECT_EQ(reply.status, 304u);
  EXPECT_TRUE(reply.content.empty());
  request.if_none_match = "\"1\"";
  EXPECT_EQ(site_.answer(request).status, 200u);
}

TEST_F(SiteTest, ThePageMayLoadItsOwnFilesOnly) {
  EXPECT_NE(header(get("/"), "Content-Security-Policy").find("default-src 'self'"), std::string::npos);
  EXPECT_EQ(header(get("/"), "X-Content-Type-Options"), "nosniff");
}

TEST_F(SiteTest, OtherMethodsAndForeignHostsAreRefused) {
  EXPECT_EQ(site_.answer({.method = "POST", .target = "/", .host = "localhost"}).status, 405u);
  EXPECT_EQ(site_.answer({.method = "GET", .target = "/", .host = "evil.com"}).status, 403u);
}

TEST_F(SiteTest, AWebSocketBeginsForWhoMayAndSpeaksTheProtocol) {
  EXPECT_EQ(site_.answer(upgrade_request()).status, 101u);
  EXPECT_EQ(site_.answer(upgrade_request()).subprotocol, "foxglove.sdk.v1");
  HttpRequest request = upgrade_request();
  request.origin = "https://evil.com";
  EXPECT_EQ(site_.answer(request).status, 403u);
  EXPECT_NE(site_.answer(request).text.find("--allow-origin"), std::string::npos);
  request = upgrade_request();
  request.target = "/assets/ok.txt";
  EXPECT_EQ(site_.answer(request).status, 404u);
  request = upgrade_request();
  request.subprotocols = "chat";
  EXPECT_EQ(site_.answer(request).status, 400u);
  request = upgrade_request();
  request.host = "evil.com";
  EXPECT_EQ(site_.answer(request).status, 403u);
  full_ = true;
  EXPECT_EQ(site_.answer(upgrade_request()).status, 503u);
}

TEST(Subprotocol, TheFirstOneThatIsSpokenIsChosen) {
  EXPECT_EQ(choose_subprotocol("foxglove.websocket.v1, foxglove.sdk.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(choose_subprotocol("a,foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(choose_subprotocol(""), "");
}

}  // namespace
}  // namespace flexcast::web
