// SPDX-License-Identifier: GPL-2.0-or-later
#include "earthquakes.h"
#include "event_tables.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "catalogue_input.h"
#include "event_time.h"
#include "files/file_error.h"
#include "files/text.h"
#include "text_bytes.h"
#include "unit_files.h"

using namespace LSM;
using namespace LSM::postproc;
using unit::contains;
using unit::expect_error;

namespace {

// The same four events in each format: Northridge, an aftershock, a quarry blast, and an earlier
// event. ComCat lists the newest first.
const std::string csv = R"(time,latitude,longitude,depth,mag,magType,nst,id,updated,place,type
1994-01-17T12:31:58.12Z,34.275,-118.493,5.3,5.89,mw,,ci3,2016,"1km NNE of Granada Hills, CA",earthquake
1994-01-17T12:30:55.39Z,34.213,-118.537,18.2,6.7,mw,,ci1,2016,"1km NNW of Reseda, ""CA""",earthquake
1994-01-16T20:00:00.00Z,34.8,-116.7,0,1.5,mc,,ci4,2016,"near Barstow, CA",quarry blast
1994-01-15T00:00:00.00Z,33.5,-116.5,5,2.01,mc,,ci5,2016,"Anza, CA",earthquake
)";
const std::string scedc =
    R"(#YYY/MM/DD HH:mm:SS.ss ET GT MAG  M    LAT     LON     DEPTH Q  EVID      NPH NGRM
1994/01/15 00:00:00.00 eq  l 2.01 c    33.500 -116.500   5.0 A  5          10   20
1994/01/16 20:00:00.00 qb  l 1.50 c    34.800 -116.700   0.0 A  4          10   20
1994/01/17 12:30:55.39 eq  l 6.70 w    34.213 -118.537  18.2 A  1         100  200
1994/01/17 12:31:58.12 eq  l 5.89 w    34.275 -118.493   5.3 A  3          50   60

# Number of rows returned (1): 4
)";
const std::string zmap =
    "-116.500\t33.500\t1994.0383562\t1\t15\t2.01\t5.0\t0\t0\t0\n"
    "-118.537 34.213 1994 01 17 6.7 18.2 12 30 55.39\n"
    "-118.493 34.275 1994 1 17 5.89 5.3 12 31 58.12\n";

std::string origin(const std::string &time, const std::string &latitude,
                   const std::string &longitude, const std::string &id) {
  return "<origin publicID=\"" + id + "\"><time><value>" + time +
         "</value></time><latitude><value>" + latitude + "</value></latitude><longitude><value>" +
         longitude + "</value></longitude></origin>\n";
}
const std::string quakeml =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<q:quakeml xmlns=\"http://quakeml.org/xmlns/bed/1.2\" "
    "xmlns:q=\"http://quakeml.org/xmlns/quakeml/1.2\">\n<eventParameters publicID=\"quakeml:x\">\n"
    "<event publicID=\"quakeml:1\"><type>earthquake</type>\n"
    " <preferredOriginID>quakeml:o2</preferredOriginID>\n"
    " <preferredMagnitudeID>quakeml:m2</preferredMagnitudeID>\n" +
    origin("1900-01-01T00:00:00Z", "0", "0", "quakeml:o1") +
    origin("1994-01-17T12:30:55.390000Z", "34.213", "-118.537", "quakeml:o2") +
    "<magnitude publicID=\"quakeml:m1\"><mag><value>6.4</value></mag></magnitude>\n"
    "<magnitude publicID=\"quakeml:m2\"><mag><value>6.7</value></mag></magnitude>\n</event>\n"
    "<event publicID=\"quakeml:3\">" +
    origin("1994-01-17T12:31:58.12", "34.275", "-118.493", "quakeml:o3") +
    "<magnitude><mag><value>5.89</value></mag></magnitude></event>\n"
    "<event publicID=\"quakeml:4\"><type>quarry blast</type>" +
    origin("1994-01-16T20:00:00Z", "34.8", "-116.7", "") +
    "</event>\n<event publicID=\"quakeml:5\"><type>earthquake</type>" +
    origin("1994-01-15T00:00:00Z", "33.5", "-116.5", "") +
    "<magnitude><mag><value>2.01</value></mag></magnitude></event>\n"
    "</eventParameters></q:quakeml>\n";

EarthquakeList read(const std::string &content, bool lenient = false,
                    const std::string &format = "") {
  unit::TextBytes bytes(content, "file");
  return read_earthquakes(bytes, format.empty() ? detect_format(content) : format, lenient);
}

/// Day since 1970 and second of each event, its place and magnitude, or why the file is refused.
std::string told(const std::string &content, const std::string &format = "") {
  std::string out;
  try {
    for (const Earthquake &one : read(content, false, format).events) {
      const double day = std::floor(one.time + 1e-9);
      out += fmt::format("{}{} {:.2f} at {} {} M {}", out.empty() ? "" : "; ", day,
                         std::fabs(one.time - day) * 86400.0, one.latitude, one.longitude,
                         one.magnitude);
    }
  } catch (const FileError &error) {
    out = error.what();
  }
  return out;
}

void refused(const std::string &content, const std::string &says, const std::string &format = "") {
  expect_error<FileError>([&] { read(content, false, format); }, says);
}

const std::string northridge = "8782 45055.39 at 34.213 -118.537 M 6.7";

const std::string geojson = R"({"features": [
{"properties": {"mag": 5.89, "time": 758809918120}, "geometry": {"coordinates": [-118.493, 34.275]}},
{"properties": {"mag": 6.7, "time": 758809855390}, "geometry": {"coordinates": [-118.537, 34.213, 1]}},
{"properties": {"mag": 2.01, "time": 758592000000}, "geometry": {"coordinates": [-116.5, 33.5, 5]}}]}
)";

TEST(Earthquakes, AllFormatsHoldTheSameEvents) {
  for (const std::string &content : {csv, scedc, zmap, quakeml, geojson}) {
    EXPECT_EQ(told(content), "8780 0.00 at 33.5 -116.5 M 2.01; " + northridge +
                                 "; 8782 45118.12 at 34.275 -118.493 M 5.89");
    const auto others = read(content).others;
    EXPECT_EQ(others.size(), content == zmap || content == geojson ? 0u : 1u);
    for (const auto &[type, count] : others) EXPECT_EQ(count, 1) << type;
    // With line ends of Windows and old Macintoshes, and with a byte order mark.
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      std::string dressed = "\xef\xbb\xbf";
      for (const char c : content) dressed += c == '\n' ? end : std::string(1, c);
      EXPECT_EQ(told(dressed), told(content)) << dressed;
      EXPECT_EQ(told(dressed.substr(3)), told(content)) << dressed;
    }
  }
}

// One table has the names of the columns of all of these.
TEST(Earthquakes, ColumnsOfAgencies) {
  const struct {
    const char *name;
    std::string text, format = "csv";
  } cases[] = {
      {"GeoNet",
       "publicid,eventtype,origintime,modificationtime,longitude, latitude, magnitude, depth\n"
       "x1,,1994-01-17T12:30:55.390Z,2020-02-17T00:21:34.988Z,-118.537,34.213,6.7,5.9\n"},
      {"FDSN",
       "#EventID | Time | Latitude | Longitude | Depth/km | Author | MagType | Magnitude | "
       "EventLocationName|EventType\n# a comment\n"
       "x1|1994-01-17T12:30:55.39|34.213|-118.537|3.6|||6.7|1 km; NNW, of Reseda|earthquake\n"},
      {"pyCSEP",
       "lon,lat,mag,time_string,depth,catalog_id,event_id\n"
       "-118.537,34.213,6.7,1994-01-17T12:30:55.390000,8.9,,x1\n"},
      {"year to second",
       "eventID,year,month,day,hour,minute,second,longitude,latitude,depth,magnitude\n"
       "1,1994,1,17,12,30,55.39,-118.537,34.213,150.0,6.7\n"},
      {"semicolons",
       "timestamp;longitude;latitude;depth;magnitude\n"
       "1994-01-17T21:30:55.390000+0900;-118.537;34.213;32.0;6.7\n"},
      {"tabs",
       "Year\tMonth\tDay\tTime\tLat\tLon\tMag\n1994\t1\t17\t12:30:55.39\t34.213\t-118.537\t6.7\n"},
      {"ISC",
       "EVENTID,TYPE,AUTHOR   ,DATE      ,TIME       ,LAT     ,LON      ,DEPTH,DEPFIX,AUTHOR   "
       ",TYPE  ,MAG \n1,ke,ISC,1994-01-17,12:30:55.39, 34.213,-118.537, 19.7,,GCMT,MW, 6.7\n"},
      {"ISC-GEM",
       "# ISC-GEM catalogue, 1904 on\n#\n#         date          ,  lat   ,   lon   , depth ,  unc "
       ",q,  mw  , unc ,q\n1994-01-17 12:30:55.39, 34.213,-118.537, 19.7,3.0,A,6.70,0.1,B\n"},
      {"NEIC's PDE",
       "Year,Month,Day,Time(hhmmss.mm)UTC,Latitude (deg),Longitude [deg],Magnitude,Depth/km\n"
       "1994,1,17,123055.39,34.213,-118.537,6.7,5\n"},
      {"NCEDC",
       "Date       Time             Lat       Lon  Depth   Mag Magt\n"
       "1994/01/17 12:30:55.39  34.213   -118.537   8.80   6.70   Mw\n"},
      {"ComCat's GeoJSON",
       "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{\"mag\""
       ":6.7,\"time\":758809855390,\"type\":\"earthquake\"},\"geometry\":{\"type\":\"Point\","
       "\"coordinates\":[-118.537,34.213,18.2]}}]}\n",
       "geojson"},
      {"EMSC's GeoJSON",
       "{\"features\":[{\"geometry\":{\"coordinates\":[-118.537,34.213,-8]},\"properties\":"
       "{\"time\":\"1994-01-17T12:30:55.39Z\",\"mag\":6.7,\"lat\":1,\"evtype\":\"ke\"}}]}",
       "geojson"}};
  for (const auto &one : cases) {
    EXPECT_EQ(detect_format(one.text), one.format) << one.name;
    EXPECT_EQ(told(one.text), northridge) << one.name;
  }
  EXPECT_EQ(detect_format("#EventID|Time|Latitude|Longitude|Magnitude\n"), "csv");
  // A longitude is no magnitude.
  EXPECT_EQ(detect_format("2009/04/06 01:32:39.00 42.334 11.334 8.8 6.3 Mw\n"), "models");
}

TEST(Earthquakes, DatesAndTimes) {
  const struct {
    double days;
    std::vector<const char *> texts;
  } good[] = {
      {0.0, {"1970-01-01"}},
      {11017.25,
       {"2000-03-01T06:00", "2000/03/01 06:00:00.0Z", "2000-3-1 6:00", "2000.03.01 06:00:00",
        "20000301060000", "200003010600", "20000301T060000Z", "2000-03-01 06:00:00 UTC",
        "1 Mar 2000 06:00", "March 1, 2000 6:00:00 AM", "2000-03-01 05:60:00", "01-Mar-2000 06:00",
        "2000-03-01T05:59:59,999999999", "2000-03-01T12:00:00+06:00"}},
      {11017.0, {"2000-02-29T18:00:00-0600"}},
      {17167.0, {"2016-12-31T23:59:60Z"}},  // a leap second
      {10881.0 + (23 * 60 + 25) / 1440.0 + 0.99 / 86400, {"1999-10-17T23:24:60.99Z"}}};
  for (const auto &[days, texts] : good)
    for (const char *const text : texts) {
      ASSERT_TRUE(parse_date(text)) << text;
      EXPECT_NEAR(*parse_date(text), days, 1e-9) << text;
    }
  for (const char *bad : {"", "2000", "2000-13-01", "2001-02-29", "2000-03-01T25:00",
                          "2000-03-01T06", "2000-03-01T06:61", "2000-03-01T06:00:91",
                          "2000-03-01T06:00x", "03/04/2000", "13/13/2000", "3 Mar 00", "0099-03-01",
                          "2000-03-01T06:00 JST", "2000-03-01T13:00 PM", "2000301", "yesterday"})
    EXPECT_FALSE(parse_date(bad)) << bad;
  EXPECT_EQ(date_text(11017.25), "2000-03-01T06:00Z");
}

// No part of a time is dropped in silence, and what a text by itself leaves open follows from all
// of its column.
TEST(Earthquakes, ColumnsOfTheTime) {
  const std::string here = "19278 23381.10", clock = "year,month,day,time";  // 06:29:41.1
  const struct {
    std::string columns, lines, expected;
  } cases[] = {
      {"year,mon,day,hour,minu,sec", "2022,10,13,6,29,41.1", here},
      {"year,month,day,hours,minutes,seconds", "2022,10,13,6,29,41.1", here},
      {"Year,Mo,Dy,Hr,Mn,Sec", "2022,10,13,6,29,41.1", here},
      {"YYYY,MM,DD,HH,MM,SS", "2022,10,13,6,29,41.1", here},
      {"dd,mm,yyyy,hh,mm,ss.s", "13,10,2022,6,29,41.1", here},
      {"year,m,d,h,m,s", "2022,Oct,13,6,29,41.1", here},
      {"date,hour,minute,second", "2022-10-13,6,29,41.1", here},
      {"second,minute,hour,date", "41.1,29,6,2022/10/13", here},
      {"Origin Date,Origin_Hour,originMinute,sec (UTC)", "20221013,6,29,41.1", here},
      {"year,month,day,HRMN,sec", "2022,10,13,0629,41.1", here},
      {"DATE,HHMM,SEC", "20221013,629,41.1", here},
      {"yyyy-mm-dd,hh:mm:ss.ss", "2022-10-13,06:29:41.10", here},
      {"date,UTC", "2022-10-13,06:29:41.1", here},
      {"Date (dd/mm/yyyy),Time (UTC)", "13/10/2022,06:29:41.1", here},
      {"date,time", "2022-10-13T06:29:41.1Z,2022-10-13T06:29:41.1Z", here},
      {"time,hour,minute,second", "2022-10-13 06:29,6,29,41.1", here},
      {"fecha,hora,fecha UTC,hora UTC", "2022-10-12,23:29:41.1,2022-10-13,06:29:41.1", here},
      {"anio,mes,dia,hora,minuto,segundo", "2022,10,13,6,29,41.1", here},
      {"Año,Mes,Día,Hora,Min,Seg", "2022,10,13,6,29,41.1", here},
      {"année,mois,jour,heure,minute,seconde", "2022,10,13,6,29,41.1", here},
      {"anno,mese,giorno,ora,minuti,secondi", "2022,10,13,6,29,41.1", here},
      {"Jahr,Monat,Tag,Stunde,Minute,Sekunde", "2022,10,13,6,29,41.1", here},
      {"date,time,timezone", "2022-10-13,15:29:41.1,+09:00", here},
      {clock, "2022,10,13,062941.1", here},
      {"year,month,day,ot,Mo", "2022,10,13,0629 41.1,5.6e26", here},
      {"year,month,day,hour,minute,second,time", "2022,10,13,6,29,41.1,2022.7815", here},
      {"year,month,day,hour,minute,second", "1107,2,12,3,,nan", "-315163 10800.00"},

      {"year,month,day,hour,second", "2022,10,13,6,41.1", "the minute as well as the second"},
      {"year,month,day,minute", "2022,10,13,29", "the hour as well as the minute"},
      {"date,hour,minute", "2022-10-13,,29", "the hour as well as the minute"},
      {"year,month,day,hour", "2022,10,13,6", "a column of minutes next to that of hours"},
      {"year,month,day,hour", "2022,,13,6", "the month as well as the hour"},
      {"year,doy,hour,minute", "2022,286,6,29", "the month as well as the minute"},
      {"date,Saat", "2022-10-13,06:29:41.1", "a name such as time for the column of '06:29:41.1'"},
      {"date,local time", "2022-10-13,14:29:41.1", "a name such as time for the column of"},
      {"date,time,ampm", "2022-10-13,06:29:41,PM", "no column ampm"},
      {"date,time,msec", "2022-10-13,06:29:41,100", "no column msec"},
      {"date,time,hour", "2022-10-13,06:29:41,14", "the same time in the column 'hour'"},
      {"date,time", "2022-10-13,2022-10-14T06:29", "the same time in the column 'date'"},
      {clock, "2022,10,13,2022.19034", "a decimal year on the day"},
      {"time", "2011.19034", "hhmm, hhmmss or hh:mm:ss"},
      {"date,time", "221013,06:29", "a possible date with a year of four digits"},
      {"date,time", "13/10/22,06:29", "a possible date with a year of four digits"},
      {"year,month,day", "83,6,15", "time is '83 6 15', expected a year from 100 to 9999 instead"},

      {clock, "2022,10,13,0546\n2022,10,13,1446", "19278 20760.00; 19278 53160.00"},
      {clock, "2022,10,13,1446\n2022,10,13,54624", "19278 886.00; 19278 20784.00"},
      {clock, "2022,10,13,2022.78\n2022,10,14,2022.79", "19278 0.00; 19279 0.00"},
      {clock, "2022,10,13,0546\n2022,10,13,144600", "either hhmm or hhmmss in the whole file"},
      {"date,time", "11/10/2022,0:00\n13/10/2022,0:00", "19276 0.00; 19278 0.00"},
      {"date", "10/11/2022\n10/13/2022", "19276 0.00; 19278 0.00"},
      {"mm/dd/yyyy", "10/11/2022", "19276 0.00"},
      {"date", "11.11.2022", "19307 0.00"},
      {"date", "06/02/2023\n07/02/2023", "a day above 12 somewhere in the file"},
      {"date", "02-13-2023\n13-02-2023", "the day first in some dates"},
      {"dd/mm/yyyy", "02/13/2023", "the day first in some dates"}};
  for (const auto &[columns, lines, expected] : cases) {
    std::string text = columns + ",lat,lon,mag\n";
    for (const char c : lines + '\n') text += c == '\n' ? ",1,1,4\n" : std::string(1, c);
    std::string found = told(text);
    for (const std::string place = " at 1 1 M 4"; contains(found, place);)
      found.erase(found.find(place), place.size());
    EXPECT_TRUE(found == expected || contains(found, expected)) << columns << ": " << found;
    EXPECT_EQ(contains(found, "expected"),
              expected.find_first_not_of("-0123456789.; ") != expected.npos)
        << text;
  }
}

TEST(Earthquakes, WhatCannotBeReadIsNamed) {
  const std::string names = "time,latitude,longitude,mag\n", time = "1994-01-17T12:30:55Z,",
                    parameters = "<quakeml><eventParameters>\n",
                    end = "</eventParameters></quakeml>\n",
                    good =
                        "{\"properties\":{\"time\":0,\"mag\":null},\"geometry\":{\"coordinates\":"
                        "[1,2,3]}}",
                    head = "{\"type\":\"FeatureCollection\",\n\"features\":[{\"properties\":",
                    place = ",\"geometry\":{\"coordinates\":[142,38,10]}}]}\n", deep(100000, '[');
  const auto lines = std::to_string(std::count(quakeml.begin(), quakeml.end(), '\n') + 3);
  const struct {
    std::string text, says, format = "";
  } cases[] = {
      {names + time + "34,-118,6.7\nmonday,34,-118,2\n",
       "file:3: time is 'monday', expected a date and time such as"},
      {names + time + "34,-118\n", "file:2: 3 fields, expected 4"},
      {names + time + "north,-118,3\n", "file:2: latitude is 'north', expected a number"},
      {names + time + "94,-118,3\n", "file:2: latitude is '94', expected a number"},
      {names + time + "34,-118,large\n", "file:2: magnitude is 'large', expected a number"},
      {"time;latitude;longitude;mag\n2020-01-01;56,1;-4,2;1,2\n",
       "latitude is '56,1', expected a number with a decimal point"},
      {"time,latitude,longitude,place,rms,mag,id\n2020-01-01,1,2,A, B,0.5,4,9\n",
       "8 fields, expected 7 (a field with a ',' needs quotes)"},
      {"time,latitude,longitude,place,mag\n2020-01-01,1,2,\"A,4\n2020-01-02,1,2,A,4\n",
       "file:2: 4 fields, expected 5 (a quote is not closed)"},
      {"a,b\n1,2\n", "file:1: column names without time, latitude, longitude and mag", "csv"},
      // A longitude is no magnitude, and a name no type.
      {"2009/04/06 01:32:39.00 42.334 11.334 8.8 6.3 Mw 100 50\n", "file:1: ", "scedc"},
      {"2009/04/06 01:32:39.00 ITALY 2.334 11.334 8.8 6.3 Mw 100 50\n", "file:1: ", "scedc"},
      {"1994/01/17 12:30:55.39 eq l 6.7\n", "file:1: 5 fields, expected date, time, event type"},
      {zmap + "-118 34 1994 13 1 2 5 0 0 0\n", "file:4: no event of ZMAP, expected longitude"},
      {"<quakeml>\n<eventParameters>\n<event>\n</eventParameters></quakeml>\n", "expected QuakeML"},
      {"<quakeml/>\n", "file: no element eventParameters, expected QuakeML"},
      {parameters + "<event><origin/></event>\n" + end,
       "file:2: time is '', expected a date and time"},
      {parameters + "<event>" + end, "file:2: mismatched tag"},
      {"<!-- nothing -->", "expected QuakeML"},
      {quakeml.substr(0, 900), "expected QuakeML"},
      {quakeml + "\n" + quakeml.substr(0, 900), "file:"},
      {quakeml + "<html><body>Too many requests</body></html>", "file: no element eventParameters"},
      {quakeml + "Error 413: too many events", "expected QuakeML"},
      {quakeml + "\n" + parameters + "<event><origin/></event>" + end,
       "file:" + lines + ": time is ''"},
      {"{\"features\":[" + good + ",\n{]}", "file:2: syntax error"},
      {"{\"a\":[]}", "file:1: no array 'features', expected GeoJSON"},
      {"{\"features\":[" + good + ",{\"properties\":{\"time\":\"x\"}}]}",
       "file: feature 2: time is 'x', expected a date and time"},
      {head + "{\"x\":" + deep + std::string(100000, ']') + "}" + place,
       "file: JSON nested more than 100 levels deep"},
      {head + "{\"mag\":5,\"place\":\"Izmir K\xf6rfezi\"}" + place,
       "file:2: syntax error while parsing value - invalid string: ill-formed UTF-8 byte, expected GeoJSON"},
      {head + "{\"mag\":5}", "unexpected end of input"},
      {head + "{\"mag\":1e400,\"time\":1}" + place, "file:2: number overflow parsing '1e400'"},
      {head + "{\"mag\":5}" + place + "{}", "file:3: syntax error"},
      {head + "{\"mag\":[5],\"time\":1299822384120}" + place,
       "feature 1: magnitude is 'array', expected a number"},
      {head + "{\"mag\":5,\"time\":1299822384.12}" + place, "expected milliseconds since 1970"},
      {head + "{\"mag\":5,\"time\":1299822384120000}" + place, "expected milliseconds since 1970"}};
  for (const auto &one : cases) refused(one.text, one.says, one.format);
  for (const char *const odd : {"1", "null", "{}", "{\"properties\":1,\"geometry\":[1]}",
                                "{\"properties\":{\"time\":{}},\"geometry\":{\"coordinates\":3}}"})
    refused("{\"features\":[" + std::string(odd) + "]}", "file: feature 1: ");
  for (const std::string year : {"83.45", "99.99", "0.01", "83", "-5", "12345"})
    refused("-116.5 33.5 " + year + " 6 15 2.1 5 0 0\n",
            "file:1: no event of ZMAP, expected longitude, latitude, year (of four");
  EXPECT_EQ(read("{\"features\":[" + good + "]}").without_magnitude, 1);
  EXPECT_EQ(told(head + "{\"mag\":5,\"time\":1299822384120,\"products\":{\"a\":[1,[2]]}}" + place),
            "15044 20784.12 at 38 142 M 5");
  const EarthquakeList list = read(csv + "nonsense\nmore\n", true);
  EXPECT_EQ(list.events.size(), 3u);
  EXPECT_EQ(list.bad_lines, 2);
  EXPECT_TRUE(contains(list.first_problem, "file:6: 1 fields, expected 11"));
}

// A type may be the type of the magnitude (ISC), a code, or unknown: only what is known to be
// something else is left out.
TEST(Earthquakes, OnlyWhatIsKnownToBeNoEarthquakeIsLeftOut) {
  const auto file_of = [](const std::vector<std::string> &types) {
    std::string text = "date,time,lat,lon,type,mag\n";
    for (const std::string &type : types)
      text += "2011-03-11,05:46:23.20, 38.2963, 142.4980," + type + ", 9.1\n";
    return text;
  };
  std::vector<std::string_view> kept;
  text::split(
      "MW,mb,ML,Mi,,earthquake,Earthquake,ke,se,fe,de,ki,si,uk,kr,null,not reported,other event,"
      "unknown,induced earthquake,induced or triggered event,rock burst,eq,eql,le,re,ts,lp,VT,vt,"
      "volcano-tectonic,LP,HB",
      kept);
  EXPECT_EQ(read(file_of({kept.begin(), kept.end()})).events.size(), kept.size());
  for (const char *const no_earthquake :
       {"quarry blast", "Quarry_Blast", "explosion", "mining explosion", "nuclear explosion", "qb",
        "km", "sm", "kn", "kx", "sn", "sonic boom", "landslide", "mine collapse", "ice quake",
        "duplicate earthquake", "not existing", "volcanic eruption", "meteorite"}) {
    const EarthquakeList list = read(file_of({"eq", no_earthquake}));
    EXPECT_EQ(list.events.size(), 1u) << no_earthquake;
    EXPECT_EQ(list.others.count(no_earthquake), 1u) << no_earthquake;
  }
  const std::string most = file_of({"qb", "eq", "qb", "explosion"});
  refused(most,
          "file: 3 of 4 events are no earthquakes (1 of type 'explosion', 2 of type 'qb'), "
          "expected less than half");
  EXPECT_EQ(read(most, true).events.size(), 1u);
}

TEST(Earthquakes, MissingValues) {
  for (const std::string none : {"", "nan", "NaN", "null", "NULL", "None", "NA", "--", "-"}) {
    const EarthquakeList list =
        read("time,latitude,longitude,depth,mag\n1994-01-17T12:30:55Z,34,-118,1," + none +
             "\n1994-01-18,34,-118," + none + ",3.1\n1994-01-19," + none + "," + none + ",1,3.2\n");
    EXPECT_EQ(list.without_magnitude, 1) << none;
    ASSERT_EQ(list.events.size(), 2u) << none;
    EXPECT_TRUE(std::isnan(list.events[1].latitude)) << none;
    EXPECT_FALSE(parse_region("-180/180/-90/90").contains(list.events[1])) << none;
  }
  EXPECT_EQ(told("-116.5\t33.5\t1994.04\t1\t15\t2.01\tNaN\t0\t0\t0\n"
                 "-116.5\t33.5\t1994.04\t1\t16\tNaN\tNaN\t0\t0\t0\n"
                 "NaN\tNaN\t1994.04\t1\t17\t2.02\tNaN\tNaN\tNaN\tNaN\n"),
            "8780 0.00 at 33.5 -116.5 M 2.01; 8782 0.00 at nan nan M 2.02");
  EXPECT_EQ(told("time\tlatitude\tlongitude\tmag\ttype\n2000-01-01\t1\t1\t4\t\n"),
            "10957 0.00 at 1 1 M 4");
  // SCEDC: the type 'n' stands for no magnitude, and files of 2003 have no type of the place.
  EXPECT_EQ(told("1981/01/01 01:49:29.23 le 2.27 c    33.724 -118.832   0.6 A 1  10   20\n"
                 "1981/01/01 04:13:55.64 le 0.00 n    33.249 -115.967   1.0 A 2  10   20\n"
                 "2019/07/06 03:19:53.04 eq  l 7.10 w    35.770 -117.599   8.0 A  1    100  200\n"
                 "2019/07/06 03:20:00.00 eq  l 0.00 n    35.770 -117.599   8.0 A  2     10   20\n"
                 "2019/07/06 03:21:00.00 eq  l 1.00      35.770 -117.599   8.0 A  2     10   20\n"),
            "4018 6569.23 at 33.724 -118.832 M 2.27; 18083 11993.04 at 35.77 -117.599 M 7.1; "
            "18083 12060.00 at 35.77 -117.599 M 1");
  // What leaves an event out is asked before what it lacks.
  const std::size_t end = quakeml.find("</eventParameters>");
  const EarthquakeList list =
      read(quakeml.substr(0, end) +
           "<event><type>not existing</type></event>\n<event><magnitude><mag>"
           "<value>5</value></mag></magnitude></event>\n" +
           quakeml.substr(end));
  EXPECT_EQ(list.events.size(), 3u);
  EXPECT_EQ(list.others.at("not existing"), 1);
  EXPECT_EQ(list.without_origin, 1);
  EXPECT_EQ(told("time,latitude,longitude,mag,type\n2020-01-01,1,2,3,eq\n?,?,?,?,quarry blast\n"),
            "18262 0.00 at 1 2 M 3");
}

TEST(Earthquakes, OddTables) {
  const std::string names = "time,latitude,longitude,depth,mag,place\n", a = "2020-01-01,1,2,3,4,",
                    b = "2020-01-02,1,2,3,4,";
  for (const std::string &text :
       {names + a + "x\n" + names + b + "y\n",
        names + a + "x\nplace,mag,time,latitude,longitude,depth\ny,4,2020-01-02,1,2,3\n",
        names + a + "\"GLEN COE\nHIGHLAND, \"\"X\"\"\"\n" + b + "y\n",
        names + a + "GLEN COE, HIGHLAND\n" + b + "y\n", names + a + "x,\n" + b + "y,,\n",
        names + a + "\"not closed\n" + b + "y\n", "sep=,\n" + names + a + "x\n" + b + "y\n",
        "time,latitude,longitude,depth,mag,place,\n" + a + "x,\n" + b + "y,\n"})
    EXPECT_EQ(told(text), "18262 0.00 at 1 2 M 4; 18263 0.00 at 1 2 M 4") << text;
  EXPECT_EQ(told("time,latitude,longitude,mag\n2020-01-01,40.18S,142.5 W,4\n"),
            "18262 0.00 at -40.18 -142.5 M 4");
}

TEST(Earthquakes, Regions) {
  const struct {
    const char *region;
    double longitude, latitude;
    bool inside;
  } cases[] = {{"-122/-114/32/37", -118, 34, true},  {"238/246/32/37", -118, 34, true},
               {"-122/-114/32/37", -113, 34, false}, {"-122/-114/32/37", -118, 38, false},
               {"170/-170/-30/0", 175, -20, true},   {"170/-170/-30/0", -175, -20, true},
               {"170/-170/-30/0", 0, -20, false}};
  for (const auto &[region, longitude, latitude, inside] : cases) {
    Earthquake event;
    event.longitude = longitude;
    event.latitude = latitude;
    EXPECT_EQ(parse_region(region).contains(event), inside) << region << ' ' << longitude;
  }
  for (const char *bad : {"", "1/2/3", "1/2/3/4/5", "1/2/4/3", "1/2/3/91", "a/2/3/4", "1/1/2/3"})
    EXPECT_THROW(parse_region(bad), std::invalid_argument) << bad;
}

class EarthquakeInput : public unit::Files {
 protected:
  EarthquakeInput() { unit::spill(path("quakes.csv"), csv); }

  EventTable table(const CatalogueOptions &options = {}) const {
    return load_catalogue(path("quakes.csv"), options);
  }
};

TEST_F(EarthquakeInput, TableOfDaysAndMagnitudes) {
  const EventTable all = table();
  ASSERT_EQ(all.events.size(), 3u);
  EXPECT_TRUE(all.earthquakes());
  EXPECT_EQ(all.label, "quakes");
  EXPECT_EQ(all.events[0].t_start, 8780.0);
  EXPECT_EQ(std::log10(all.events[1].size) / 1.5, 6.7);
  ASSERT_EQ(all.repairs.size(), 1u);
  EXPECT_TRUE(contains(all.repairs[0], "left out 1 of type 'quarry blast'"));
  EXPECT_EQ(Threshold().of(all).size, size_of_magnitude(2.01));
}

TEST_F(EarthquakeInput, Selection) {
  CatalogueOptions options;
  options.min_size = size_of_magnitude(5.89);
  EXPECT_EQ(table(options).events.size(), 2u);
  options.to_day = *parse_date("1994-01-17T12:31");
  EXPECT_EQ(table(options).events.size(), 1u);
  options = {};
  options.paths = {path("quakes.csv")};
  options.regions = {"-119/-118/34/35", "-117/-116/33/34"};
  const auto tables = load_catalogues(options);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].events.size(), 2u);
  EXPECT_EQ(tables[1].events.size(), 1u);
  EXPECT_TRUE(contains(tables[1].repairs.back(), "left out 2 outside of -117/-116/33/34"));
  options.regions.clear();
  options.from_time = 1984;
  expect_error<std::invalid_argument>(
      [&] { load_catalogues(options); },
      "all catalogues are of earthquakes, expected a date such as 1984-01-01");
}

// Files that were joined by the shell, or whose downloads were in chunks; values on lines of their
// own.
TEST(Earthquakes, QuakemlInAnyLayout) {
  const std::string comment = "<!-- <event> is no event here -->\n", mark = "\xef\xbb\xbf";
  const std::size_t begin = quakeml.find("<eventParameters"), end = quakeml.find("</q:quakeml>");
  const std::string parameters = quakeml.substr(begin, end - begin);
  for (const std::string &content :
       {quakeml + quakeml + quakeml,
        mark + quakeml + "\r\n" + mark + quakeml + comment + quakeml + comment,
        quakeml.substr(0, end) + parameters + parameters + "</q:quakeml>"}) {
    const EarthquakeList list = read(content);
    EXPECT_EQ(list.events.size(), 9u);
    EXPECT_EQ(list.others.at("quarry blast"), 3);
  }
  // Wherever the blocks end in which a file is read.
  for (std::size_t gap = 0; gap < quakeml.size(); gap += 3) {
    const std::string blanks((1 << 16) - quakeml.size() - gap, ' ');
    EXPECT_EQ(read(quakeml + blanks + quakeml).events.size(), 6u) << gap;
    EXPECT_EQ(
        read("<!--" + blanks + "-->" + quakeml.substr(quakeml.find("<q:")) + quakeml).events.size(),
        6u)
        << gap;
  }
  // One long line, of which each part is read only once.
  std::string text = quakeml.substr(0, end) + std::string(60 << 20, ' ') + "</q:quakeml>";
  std::replace(text.begin(), text.end(), '\n', ' ');
  EXPECT_EQ(told(text), told(quakeml));
  text.clear();
  for (const char c : quakeml) {
    if (c == '<' && text.back() != '>' && text.back() != '\n') text += "\n   ";
    text += c;
    if (c == '>') text += "\r\n\t ";
  }
  text.replace(text.find("quakeml:m2\""), 11, " \n quakeml:m2 \"");
  EXPECT_EQ(told(text), told(quakeml));
  EXPECT_EQ(read(text).others, read(quakeml).others);
  EXPECT_EQ(read(text).not_preferred, 0);
  text.replace(text.find("quakeml:m2"), 10, "quakeml:m3");
  EXPECT_EQ(read(text).events[1].magnitude, 6.4);
  EXPECT_EQ(read(text).not_preferred, 1);
}

TEST(Earthquakes, NumbersThatStandForNoMagnitude) {
  std::string good = "time,latitude,longitude,mag\n";
  for (int k = 0; k < 30; ++k) good += fmt::format("2020-01-01,1,2,{:.1f}\n", 2.5 + 0.1 * (k % 9));
  const auto left = [&](const std::string &magnitude, int times) {
    std::string text = good;
    for (int k = 0; k < times; ++k) text += "2020-01-02,1,2," + magnitude + "\n";
    return read(text).events.size();
  };
  for (const char *none : {"-9", "-9.9", "-9.99", "-99", "-99.0", "-999", "-9999.00", "99", "99.9",
                           "99.99", "9.99", "9.90", "-10", "999"})
    EXPECT_EQ(left(none, 1), 30u) << none;
  for (const char *none : {"0", "0.0", "-1", "-1.00", "-5"}) {
    EXPECT_EQ(left(none, 3), 30u) << none;
    EXPECT_EQ(left(none, 2), 32u) << none;  // too few to tell
  }
  for (const char *some : {"-3.2", "-1.5", "0.9", "9.5", "-8.5"})
    EXPECT_EQ(left(some, 3), 33u) << some;
  // Small earthquakes fill the range down to 0.
  for (int k = 0; k < 10; ++k) good += fmt::format("2020-01-02,1,2,{:.1f}\n", 0.2 * k);
  EXPECT_EQ(left("0.0", 2), 42u);
  EXPECT_EQ(read(good + "2020-01-02,1,2,-9.90\n").fillers.at("-9.90"), 1);
  // Where agencies have columns of their own, 0 beside another magnitude is none.
  const std::string columns =
      "time,latitude,longitude,xM,MD,ML,Mw\n2020-01-01,1,2,4.1,4.1,0.0,0.0\n"
      "2020-01-02,1,2,5.0,0.0,4.9,5.0\n";
  EXPECT_EQ(told(columns), "18263 0.00 at 1 2 M 5");
  EXPECT_EQ(read(columns).fillers.at("0"), 1);
}

}  // namespace
